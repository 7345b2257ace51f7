#!/bin/sh
# usage: page_in_browser.sh PROGRAM MAP   the page of a result in Debian's chromium, without a display and without a graphics card. MAP is
# a COLMAP model in text. Skipped where chromium is not installed; it is large, and only the full continuous integration installs it.
program=$1
map=$2
if ! command -v chromium > /dev/null; then
  echo "chromium is missing (Debian package chromium): skipped"
  exit 77
fi
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }
mkdir "$scratch/map" "$scratch/images" && cp "$map"/*.txt "$scratch/map" && cd "$scratch" || exit 1
# A name that is markup, and an image for another: PNG, one pixel.
sed -i "s#photo_02.jpg#</script><img/src=x/onerror=document.title=1>\\&amp;\"'.jpg#" map/images.txt
printf '%s' iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg== | base64 -d > images/photo_01.jpg
"$program" localize map --quiet --html_path page.html --image_path images > table || fail "the page"

# Clicks and looks; what it finds stands in the document at the end.
cat > look.html << 'END'
<script>
const faults = [];
const expect = (isRight, what) => { if (!isRight) faults.push(what); };
const drawn = () => Number(document.documentElement.dataset.drawn), sum = () => document.documentElement.dataset.sum;
const rows = () => [...document.querySelectorAll("#images tbody tr")];
const names = () => rows().map(row => row.cells[0].textContent);
const name = "</" + "script><img/src=x/onerror=document.title=1>&amp;\"'.jpg";
window.addEventListener("load", () => {
  expect(drawn() > 1000, "only " + drawn() + " pixels are drawn");
  expect(names().includes(name), "the name is not shown as it is: " + names().join(" "));
  expect(document.querySelectorAll("img").length === 0, "a name became an element");
  expect(document.title === "HybridGV", "a name became a script");
  expect(document.querySelectorAll("#picture image").length === 1, "the image is not shown");
  const first = sum(), picture = document.getElementById("picture").innerHTML;
  rows()[names().indexOf(name)].click();
  expect(sum() !== first, "choosing an image does not change the map");
  expect(document.getElementById("picture").innerHTML !== picture, "choosing an image does not change the picture");
  expect(document.querySelectorAll("#picture image").length === 0, "another image's picture is shown");
  expect(document.getElementById("name").textContent === name, "the chosen image's name");
  const chosen = sum();
  document.getElementById("through").click();
  expect(sum() !== chosen && drawn() > 500, "looking through an image");
  document.querySelectorAll("#images th button")[1].click();
  const lengths = rows().map(row => parseFloat(row.cells[1].textContent));
  expect(lengths.every((f, i) => i === 0 || lengths[i - 1] <= f), "the table is not sorted");
  document.getElementById("showSegments").click();
  expect(document.querySelectorAll("#picture polyline").length > 5, "no epipolar segments");
  const verdict = document.createElement("p");
  verdict.textContent = "verdict: " + (faults.join("; ") || "right");
  document.body.append(verdict);
});
</script>
END
cat > no_webgl.html << 'END'
<script>
const original = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind === "webgl" ? null : original.call(this, kind, ...rest); };
</script>
END
cat page.html look.html > webgl.html
cat no_webgl.html page.html look.html > plain.html
for page in webgl plain; do
  HOME=$scratch timeout 120 chromium --headless --no-sandbox --disable-dev-shm-usage --use-angle=swiftshader --enable-unsafe-swiftshader \
    --virtual-time-budget=8000 --window-size=1400,1000 --enable-logging=stderr --dump-dom "file://$scratch/$page.html" > dom 2> log || fail "chromium: $(tail -3 log)"
  grep -o '<p>verdict: [^<]*' dom | sed 's/^<p>//' > verdict
  echo "$page: $(cat verdict)"
  [ "$(cat verdict)" = "verdict: right" ] || fail "$page"
  if grep 'CONSOLE' log; then fail "the console of $page has messages"; fi
done
