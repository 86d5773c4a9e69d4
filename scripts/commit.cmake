# Run at each build (cmake -DSOURCE=... -DOUT=... -P): writes the commit of the sources into a header, only if it has
# changed, so that nothing is compiled without need.
execute_process(COMMAND git describe --always --abbrev=9 --dirty=+changes --exclude=*
                WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
                RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#define NONET_COMMIT \"${commit}\"\n")
