# Writes kardan_build_info.hpp; run at every build so that the commit is the one built. Touches the file only if it changes.
# Arguments: SOURCE, OUTPUT, VERSION, COMPILER, FLAGS
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=10 --dirty=-modified --exclude *
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR commit STREQUAL "")
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once
#define KARDAN_VERSION \"${VERSION}\"
#define KARDAN_COMMIT \"${commit}\"
#define KARDAN_COMPILER \"${COMPILER}\"
#define KARDAN_FLAGS \"${FLAGS}\"
")
