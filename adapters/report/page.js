"use strict";
(() => {
  const element = id => document.getElementById(id);
  const data = JSON.parse(element("data").textContent);

  // ---- Data: arrays are base64 of little endian numbers.
  const bytesOf = text => Uint8Array.from(atob(text || ""), c => c.charCodeAt(0));
  const floatsOf = text => new Float32Array(bytesOf(text).buffer);
  const positions = floatsOf(data.points), colours = bytesOf(data.colours);
  // Readers of models without colours set them to black.
  if (colours.every(value => value === 0)) colours.fill(200);
  const up = [...floatsOf(data.up)];
  const localized = data.images.filter(image => image.success);
  for (const image of localized) image.pose = floatsOf(image.pose);
  let chosen = null;

  // ---- Small vectors.
  const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
  const unit = a => scaled(a, 1 / (Math.hypot(...a) || 1));

  // ---- The viewer's camera: x to the right, y down, z forward, as the cameras of the map.
  const east = unit(cross(up, Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0])), north = cross(up, east);
  const view = { target: [0, 0, 0], distance: 3 * data.radius, yaw: 0.6, pitch: -0.35, through: null };
  // At first from where the map's cameras look on the whole: most of them show what they have in front of them.
  const mapCameras = floatsOf(data.mapCameras), queryCameras = floatsOf(data.queryCameras);
  (() => {
    let forward = [0, 0, 0];
    for (let i = 0; i + 15 <= mapCameras.length; i += 15) {
      const centre = mapCameras.subarray(i, i + 3);
      let middle = [0, 0, 0];
      for (let k = 1; k < 5; ++k) middle = add(middle, mapCameras.subarray(i + 3 * k, i + 3 * k + 3), 0.25);
      forward = add(forward, unit(add(middle, centre, -1)));
    }
    if (Math.hypot(...forward) > 1e-3) view.yaw = Math.atan2(dot(forward, north), dot(forward, east)) + 0.35;
  })();

  const orbitCamera = () => {
    const level = add(scaled(east, Math.cos(view.yaw)), north, Math.sin(view.yaw));
    const forward = add(scaled(level, Math.cos(view.pitch)), up, Math.sin(view.pitch));
    const right = unit(cross(forward, up));
    return { eye: add(view.target, forward, -view.distance), right, down: cross(forward, right), forward, tangent: null };
  };
  const kTangent = 0.4;  // of half the angle of view, of the canvas's shorter side
  // The cameras, and the points that are not far away from all others.
  const places = (() => {
    const found = [];
    for (const frusta of [mapCameras, queryCameras]) for (let i = 0; i < frusta.length; i += 3) found.push([...frusta.subarray(i, i + 3)]);
    const step = 3 * Math.ceil(positions.length / 3 / 2000);
    for (let i = 0; i < positions.length; i += step) {
      const place = [...positions.subarray(i, i + 3)];
      if (Math.hypot(...place) <= data.radius) found.push(place);
    }
    return found;
  })();
  const showAll = () => {
    view.through = null;
    if (places.length === 0) return;
    const { right, down, forward } = orbitCamera();
    const middle = axis => {
      let low = Infinity, high = -Infinity;
      for (const place of places) { const at = dot(place, axis); low = Math.min(low, at); high = Math.max(high, at); }
      return scaled(axis, (low + high) / 2);
    };
    view.target = add(add(middle(right), middle(down)), middle(forward));
    view.distance = 0.1 * data.radius;
    for (const place of places) {
      const p = add(place, view.target, -1);
      const side = Math.max(Math.abs(dot(p, right)), Math.abs(dot(p, down)));
      view.distance = Math.max(view.distance, 1.05 * side / kTangent - dot(p, forward));
    }
  };
  const imageCamera = image => {
    const p = image.pose, f = image.focalLength;
    return { eye: [...p.subarray(0, 3)], right: [...p.subarray(3, 6)], down: [...p.subarray(6, 9)], forward: [...p.subarray(9, 12)],
      tangent: [image.width / 2 / f, image.height / 2 / f] };
  };
  // Tangents of half the angles of view in x and y.
  const tangents = (camera, width, height) => {
    const wide = width / height;
    if (!camera.tangent) return wide > 1 ? [kTangent * wide, kTangent] : [kTangent, kTangent / wide];
    const y = Math.max(camera.tangent[1], camera.tangent[0] / wide);
    return [y * wide, y];
  };
  const currentCamera = () => (view.through ? imageCamera(view.through) : orbitCamera());
  // Column by column, as WebGL wants it.
  const matrixOf = (camera, width, height) => {
    const [tx, ty] = tangents(camera, width, height);
    const near = data.radius * 1e-3, far = data.radius * 1e4;
    const a = (far + near) / (far - near), b = -2 * far * near / (far - near);
    const rows = [scaled(camera.right, 1 / tx), scaled(camera.down, -1 / ty), scaled(camera.forward, a), camera.forward];
    const shift = rows.map(row => -dot(row, camera.eye));
    shift[2] += b;
    const m = new Float32Array(16);
    for (let r = 0; r < 4; ++r) {
      for (let c = 0; c < 3; ++c) m[4 * c + r] = rows[r][c];
      m[12 + r] = shift[r];
    }
    return m;
  };
  const project = (m, x, y, z) => {
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    return [(m[0] * x + m[4] * y + m[8] * z + m[12]) / w, (m[1] * x + m[5] * y + m[9] * z + m[13]) / w, w];
  };

  // ---- Lines of the frusta.
  const edges = [[0, 1], [0, 2], [0, 3], [0, 4], [1, 2], [2, 3], [3, 4], [4, 1]];
  const linesOf = frusta => {
    const lines = [];
    for (let i = 0; i + 15 <= frusta.length; i += 15)
      for (const edge of edges)
        for (const corner of edge) lines.push(...frusta.subarray(i + 3 * corner, i + 3 * corner + 3));
    return new Float32Array(lines);
  };
  const mapLines = linesOf(mapCameras), queryLines = linesOf(queryCameras);
  const chosenLines = () => {
    const i = localized.indexOf(chosen);
    return i < 0 ? new Float32Array(0) : linesOf(queryCameras.subarray(15 * i, 15 * i + 15));
  };
  const groups = () => [[mapLines, [0.44, 0.66, 1]], [queryLines, [1, 0.42, 0.37]], [chosenLines(), [1, 0.85, 0.29]]];
  const pointSize = () => Number(element("size").value);

  // ---- Drawing with WebGL.
  const canvas = element("view");
  const background = [0.07, 0.086, 0.114];
  const webglPainter = () => {
    const gl = canvas.getContext("webgl", { antialias: true });
    if (!gl) return null;
    const shader = (kind, source) => {
      const made = gl.createShader(kind);
      gl.shaderSource(made, source);
      gl.compileShader(made);
      return made;
    };
    const program = gl.createProgram();
    gl.attachShader(program, shader(gl.VERTEX_SHADER,
      "attribute vec3 place; attribute vec3 colour; uniform mat4 matrix; uniform float size; varying vec3 shade;" +
      "void main() { gl_Position = matrix * vec4(place, 1.0); gl_PointSize = size; shade = colour; }"));
    gl.attachShader(program, shader(gl.FRAGMENT_SHADER,
      "precision mediump float; varying vec3 shade; void main() { gl_FragColor = vec4(shade, 1.0); }"));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);  // the chosen camera is drawn over itself
    const place = gl.getAttribLocation(program, "place"), colour = gl.getAttribLocation(program, "colour");
    const matrix = gl.getUniformLocation(program, "matrix"), size = gl.getUniformLocation(program, "size");
    const bufferOf = values => {
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      return buffer;
    };
    const points = bufferOf(positions), shades = bufferOf(colours), lines = gl.createBuffer();
    gl.enableVertexAttribArray(place);
    return {
      draw(m) {
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.clearColor(...background, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.uniformMatrix4fv(matrix, false, m);
        gl.uniform1f(size, pointSize() * (window.devicePixelRatio || 1));
        gl.bindBuffer(gl.ARRAY_BUFFER, points);
        gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
        gl.bindBuffer(gl.ARRAY_BUFFER, shades);
        gl.enableVertexAttribArray(colour);
        gl.vertexAttribPointer(colour, 3, gl.UNSIGNED_BYTE, true, 0, 0);
        gl.drawArrays(gl.POINTS, 0, positions.length / 3);
        gl.disableVertexAttribArray(colour);
        gl.bindBuffer(gl.ARRAY_BUFFER, lines);
        for (const [values, shade] of groups()) {
          if (values.length === 0) continue;
          gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
          gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
          gl.vertexAttrib3f(colour, ...shade);
          gl.drawArrays(gl.LINES, 0, values.length / 3);
        }
      },
      pixels() {
        const pixels = new Uint8Array(4 * canvas.width * canvas.height);
        gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return pixels;
      }
    };
  };

  // ---- The same without WebGL: nearer points hide farther ones only by their order.
  const plainPainter = () => {
    const context = canvas.getContext("2d", { willReadFrequently: true });
    const css = shade => "rgb(" + shade.map(v => Math.round(255 * v)).join(",") + ")";
    const place = p => [(p[0] + 1) / 2 * canvas.width, (1 - p[1]) / 2 * canvas.height];
    return {
      draw(m) {
        context.fillStyle = css(background);
        context.fillRect(0, 0, canvas.width, canvas.height);
        const size = pointSize() * (window.devicePixelRatio || 1);
        for (let i = 0; i < positions.length; i += 3) {
          const p = project(m, positions[i], positions[i + 1], positions[i + 2]);
          if (p[2] <= 0) continue;
          context.fillStyle = "rgb(" + colours[i] + "," + colours[i + 1] + "," + colours[i + 2] + ")";
          context.fillRect(...place(p), size, size);
        }
        for (const [values, shade] of groups()) {
          context.strokeStyle = css(shade);
          context.beginPath();
          for (let i = 0; i + 6 <= values.length; i += 6) {
            const a = project(m, values[i], values[i + 1], values[i + 2]), b = project(m, values[i + 3], values[i + 4], values[i + 5]);
            if (a[2] <= 0 || b[2] <= 0) continue;
            context.moveTo(...place(a));
            context.lineTo(...place(b));
          }
          context.stroke();
        }
      },
      pixels: () => context.getImageData(0, 0, canvas.width, canvas.height).data
    };
  };
  const painter = webglPainter() || plainPainter();

  // What was drawn, for whoever looks at the page without eyes: the number of pixels that are not background, and a sum that changes with
  // the picture.
  const countPixels = () => {
    const pixels = painter.pixels();
    const empty = background.map(v => Math.round(255 * v));
    let drawn = 0, sum = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if (Math.abs(pixels[i] - empty[0]) + Math.abs(pixels[i + 1] - empty[1]) + Math.abs(pixels[i + 2] - empty[2]) > 6) ++drawn;
      sum = (31 * sum + pixels[i] + 3 * pixels[i + 1] + 7 * pixels[i + 2]) % 1000000007;
    }
    document.documentElement.dataset.drawn = drawn;
    document.documentElement.dataset.sum = sum;
  };
  const draw = () => {
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    painter.draw(matrixOf(currentCamera(), canvas.width, canvas.height));
  };
  // While something moves, once for each picture of the screen.
  let isWaiting = false;
  const redrawSoon = () => {
    if (isWaiting) return;
    isWaiting = true;
    requestAnimationFrame(() => {
      isWaiting = false;
      draw();
    });
  };
  const redraw = () => {
    draw();
    countPixels();
  };

  // ---- Turning, moving, zooming, choosing.
  const nearestImage = event => {
    const box = canvas.getBoundingClientRect();
    const m = matrixOf(currentCamera(), box.width, box.height);
    let best = null, smallest = 20;
    for (const image of localized) {
      const p = project(m, image.pose[0], image.pose[1], image.pose[2]);
      if (p[2] <= 0) continue;
      const distance = Math.hypot((p[0] + 1) / 2 * box.width - (event.clientX - box.left), (1 - p[1]) / 2 * box.height - (event.clientY - box.top));
      if (distance < smallest) [best, smallest] = [image, distance];
    }
    return best;
  };
  const lookThrough = image => {
    if (!image || !image.success) return;
    choose(image);
    view.through = image;
    redraw();
  };
  let drag = null;
  canvas.addEventListener("pointerdown", event => {
    drag = { x: event.clientX, y: event.clientY, moves: event.shiftKey || event.button !== 0, far: 0 };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", event => {
    if (!drag) return;
    const dx = event.clientX - drag.x, dy = event.clientY - drag.y;
    drag.far += Math.abs(dx) + Math.abs(dy);
    [drag.x, drag.y] = [event.clientX, event.clientY];
    if (drag.far < 4) return;
    view.through = null;
    if (drag.moves) {
      const camera = orbitCamera(), step = 0.8 * view.distance / canvas.clientHeight;
      view.target = add(add(view.target, camera.right, -dx * step), camera.down, -dy * step);
    } else {
      view.yaw -= dx * 0.006;
      view.pitch = Math.max(-1.55, Math.min(1.55, view.pitch - dy * 0.006));
    }
    redrawSoon();
  });
  canvas.addEventListener("pointerup", event => {
    const image = drag && drag.far < 4 && !drag.moves ? nearestImage(event) : null;
    drag = null;
    if (image) choose(image);
  });
  canvas.addEventListener("pointercancel", () => { drag = null; });
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("dblclick", event => lookThrough(nearestImage(event)));
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    view.through = null;
    view.distance *= Math.exp(Math.sign(event.deltaY) * 0.12);
    redrawSoon();
  }, { passive: false });
  canvas.addEventListener("keydown", event => {
    const turns = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    const zooms = { "+": 0.88, "-": 1.13 }[event.key];
    if (!turns && !zooms) return;
    event.preventDefault();
    view.through = null;
    if (turns) [view.yaw, view.pitch] = [view.yaw + turns[0], Math.max(-1.55, Math.min(1.55, view.pitch + turns[1]))];
    if (zooms) view.distance *= zooms;
    redrawSoon();
  });
  element("whole").addEventListener("click", () => { showAll(); redraw(); });
  element("through").addEventListener("click", () => lookThrough(chosen));
  element("size").addEventListener("input", () => redrawSoon());
  window.addEventListener("resize", () => redrawSoon());

  // ---- The chosen image. Names are somebody's text: they are never parsed.
  const make = (name, text, className) => {
    const made = document.createElement(name);
    if (text !== undefined) made.textContent = text;
    if (className) made.className = className;
    return made;
  };
  const nameOf = text => { const made = make("bdi", text); made.dir = "auto"; return made; };
  const svg = (name, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key of Object.keys(attributes)) made.setAttribute(key, attributes[key]);
    return made;
  };
  const number = (value, digits) => (typeof value === "number" ? value.toFixed(digits) : "");
  const withDeviation = (value, deviation, digits) =>
    typeof value === "number" ? number(value, digits) + (deviation > 0 ? " \u00b1 " + number(deviation, digits) : "") : "";

  const segmentsOf = image => {
    const values = floatsOf(image.segments), segments = [];
    let first = 0;
    for (const length of bytesOf(image.lengths)) {
      segments.push([...values.subarray(first, first + 2 * length)]);
      first += 2 * length;
    }
    return segments;
  };
  const drawPicture = image => {
    const width = image.width || 1, height = image.height || 1, size = Math.max(width, height) / 160;
    const picture = svg("svg", { viewBox: "0 0 " + width + " " + height, role: "img", "aria-label": "correspondences in the image" });
    if (image.address) picture.append(svg("image", { href: image.address, width, height, preserveAspectRatio: "none" }));
    const marks = [floatsOf(image.marks2d3d), floatsOf(image.marks2d2d)];
    const inliers = [bytesOf(image.inliers2d3d), bytesOf(image.inliers2d2d)];
    const segments = segmentsOf(image);
    const line = values => svg("polyline", { points: values.join(" "), "stroke-width": size / 4 });
    const place = (kind, i) => [marks[kind][2 * i], marks[kind][2 * i + 1]];
    const drawOutliers = kind => inliers[kind].forEach((good, i) => {
      const [x, y] = place(kind, i), h = size / 2;
      if (!good)
        picture.append(svg("path", { d: `M${x - h} ${y - h}L${x + h} ${y + h}M${x - h} ${y + h}L${x + h} ${y - h}`, class: "outlier", "stroke-width": size / 5 }));
    });
    if (element("showOutliers").checked) { drawOutliers(0); drawOutliers(1); }
    if (element("showSegments").checked) for (const values of segments) if (values.length >= 4) picture.append(line(values));
    if (element("showRays").checked) inliers[1].forEach((good, i) => {
      if (!good) return;
      const [x, y] = place(1, i);
      const ring = svg("circle", { cx: x, cy: y, r: size / 2, class: "ray", "stroke-width": size / 4 });
      let shown = null;
      ring.addEventListener("pointerenter", () => { if (segments[i] && segments[i].length >= 4) picture.append(shown = line(segments[i])); });
      ring.addEventListener("pointerleave", () => { if (shown) shown.remove(); shown = null; });
      picture.append(ring);
    });
    if (element("showPoints").checked) inliers[0].forEach((good, i) => {
      const [x, y] = place(0, i);
      if (good) picture.append(svg("circle", { cx: x, cy: y, r: size / 2, class: "point", "stroke-width": size / 10 }));
    });
    element("picture").replaceChildren(picture);
  };
  const showNumbers = image => {
    const rows = image.success ? [["focal length [px]", withDeviation(image.focalLength, image.focalLengthDeviation, 2)],
      ["distortion k1", withDeviation(image.k1, image.k1Deviation, 4)]] : [["not localized", image.reason]];
    rows.push(["2D-3D inliers", image.good2d3d + " of " + image.number2d3d], ["2D-2D inliers", image.good2d2d + " of " + image.number2d2d]);
    if (image.number2d2d + image.number2d3d > 0 && image.marks2d3d === undefined)
      rows.push(["correspondences", "not in this page: it has too many"]);
    element("numbers").replaceChildren(...rows.flatMap(([key, value]) => [make("dt", key), make("dd", value)]));
  };
  const showShares = image => {
    const table = element("shares"), used = image.mapImages.filter(share => share.matches > 0);
    table.replaceChildren();
    if (used.length === 0) return;
    const head = make("tr");
    for (const title of ["map image", "matches", "2D-3D inliers", "2D-2D inliers"]) head.append(make("th", title));
    table.append(head);
    for (const share of used) {
      const row = make("tr"), name = make("td");
      name.append(nameOf(share.name));
      row.append(name);
      for (const value of [share.matches, share.inliers2d3d, share.inliers2d2d]) row.append(make("td", value));
      table.append(row);
    }
  };
  const choose = image => {
    chosen = image;
    if (view.through && view.through !== image) view.through = image.success ? image : null;
    element("name").textContent = image.name;
    element("through").disabled = !image.success;
    drawPicture(image);
    showNumbers(image);
    showShares(image);
    for (const row of element("images").querySelectorAll("tbody tr")) row.classList.toggle("chosen", data.images[row.dataset.index] === image);
    redraw();
  };
  for (const id of ["showPoints", "showRays", "showOutliers", "showSegments"])
    element(id).addEventListener("change", () => { if (chosen) drawPicture(chosen); });

  // ---- The table of all images.
  const columns = [
    ["image", image => image.name, image => nameOf(image.name)],
    ["f [px]", image => image.focalLength, image => withDeviation(image.focalLength, image.focalLengthDeviation, 1)],
    ["f \u00b1 [%]", image => 100 * image.focalLengthDeviation / image.focalLength, image => image.success ? number(100 * image.focalLengthDeviation / image.focalLength, 3) : ""],
    ["k1", image => image.k1, image => withDeviation(image.k1, image.k1Deviation, 4)],
    ["2D-3D inliers", image => image.good2d3d, image => image.good2d3d + "/" + image.number2d3d],
    ["2D-2D inliers", image => image.good2d2d, image => image.good2d2d + "/" + image.number2d2d],
    ["ms", image => image.seconds, image => number(1000 * image.seconds, 1)],
    ["", image => image.success ? "localized" : image.reason, image => image.success ? "localized" : image.reason]];
  let order = { column: -1, sign: 1 };
  const comparable = value => (typeof value === "string" ? value : Number.isFinite(value) ? value : Infinity);
  const fillTable = () => {
    const indices = data.images.map((image, i) => i);
    if (order.column >= 0) {
      const key = i => comparable(columns[order.column][1](data.images[i]));
      indices.sort((a, b) => { const x = key(a), y = key(b); return order.sign * (x < y ? -1 : x > y ? 1 : 0) || a - b; });
    }
    const body = make("tbody");
    for (const i of indices) {
      const row = make("tr", undefined, data.images[i].success ? "" : "failed");
      row.dataset.index = i;
      row.tabIndex = 0;
      for (const column of columns) { const cell = make("td"); cell.append(column[2](data.images[i])); row.append(cell); }
      row.addEventListener("click", () => choose(data.images[i]));
      row.addEventListener("keydown", event => { if (event.key === "Enter") choose(data.images[i]); });
      row.classList.toggle("chosen", data.images[i] === chosen);
      body.append(row);
    }
    const old = element("images").querySelector("tbody");
    if (old) old.replaceWith(body); else element("images").append(body);
  };
  const head = make("tr");
  columns.forEach((column, i) => {
    const cell = make("th"), button = make("button", column[0] || "result");
    button.addEventListener("click", () => { order = { column: i, sign: order.column === i ? -order.sign : 1 }; fillTable(); });
    cell.append(button);
    head.append(cell);
  });
  element("images").append(make("thead"));
  element("images").querySelector("thead").append(head);
  fillTable();

  // ---- What the page says about itself.
  document.title = data.title;
  element("title").textContent = data.title;
  element("summary").textContent = localized.length + " of " + data.images.length + " images localized; the map has " +
    mapCameras.length / 15 + " cameras and " + data.numberPoints + " points";
  const notes = [];
  if (data.stride > 1) notes.push("One of " + data.stride + " points of the map is drawn.");
  if (data.images.some(image => image.number2d2d + image.number2d3d > 0 && image.marks2d3d === undefined))
    notes.push("Of some images the correspondences are not in this page, because all together they are too many.");
  element("notes").textContent = notes.join(" ");
  showAll();
  if (data.images.length > 0) choose(localized[0] || data.images[0]);
  redraw();
})();
