# Warnings for this project's own targets only; never forced on those who use it.
function(hybridgv_set_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic $<$<BOOL:${HYBRIDGV_WERROR}>:-Werror>)
endfunction()
