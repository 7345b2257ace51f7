# The Python package as it is in the build tree: pytest, and mypy on its types. Where these are missing the tests are skipped.
set(python_environment PYTHONPATH=${PROJECT_BINARY_DIR}/adapters/python PYTHONDONTWRITEBYTECODE=1)
# hybridgv_python_test(name ARGUMENTS ...): a test that says "skipped:" did not run
function(hybridgv_python_test name)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} ${ARGN})
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "${python_environment}" SKIP_REGULAR_EXPRESSION "skipped:")
endfunction()
file(GLOB python_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/test_*.py)
foreach(file ${python_tests})
  get_filename_component(name ${file} NAME_WE)
  hybridgv_python_test(python_${name} ${CMAKE_CURRENT_LIST_DIR}/run.py ${file})
endforeach()
hybridgv_python_test(python_types ${CMAKE_CURRENT_LIST_DIR}/check_types.py)
