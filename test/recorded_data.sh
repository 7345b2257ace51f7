# Read by the scripts that run tests, in the project's folder: says where the recorded data of some tests lie, which are no part of the
# sources. HYBRIDGV_REALDATA_DIR (sparse models) and HYBRIDGV_GOLDEN_DIR (minimal problems) name the folders; where they are not set,
# those of ../shared are taken if they hold what the tests read. Without data these tests are skipped.
if [ -z "$HYBRIDGV_REALDATA_DIR" ] && [ -f ../shared/realdata/kermit/bundle.out ]; then
  HYBRIDGV_REALDATA_DIR=$(cd ../shared/realdata && pwd)
fi
if [ -z "$HYBRIDGV_GOLDEN_DIR" ] && [ -f ../shared/golden/h13f.txt ]; then
  HYBRIDGV_GOLDEN_DIR=$(cd ../shared/golden && pwd)
fi
export HYBRIDGV_REALDATA_DIR HYBRIDGV_GOLDEN_DIR
echo "recorded models: ${HYBRIDGV_REALDATA_DIR:-none}, recorded problems: ${HYBRIDGV_GOLDEN_DIR:-none}"
