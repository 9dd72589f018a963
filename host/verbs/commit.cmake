# Writes OUTPUT, which tells the commit that is built: of git where SOURCE is a clone, else of what `git archive` has
# written. Run in every build; a file that would say the same is left alone.
set(GIT git -C ${SOURCE} -c safe.directory=*)
set(commit)
set(date)
if(EXISTS ${SOURCE}/.git)
    execute_process(COMMAND ${GIT} describe --always --dirty --abbrev=12 --exclude=*
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    execute_process(COMMAND ${GIT} show --no-patch --format=%cs HEAD
        OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
else()
    file(STRINGS ${SOURCE}/host/verbs/archived_commit.txt words LIMIT_COUNT 1)
    if(words MATCHES "^([0-9a-f]+) ([0-9-]+)$")
        set(commit ${CMAKE_MATCH_1})
        set(date ${CMAKE_MATCH_2})
    endif()
endif()
if(NOT commit OR NOT date)
    set(commit unknown)
    string(TIMESTAMP date "%Y-%m-%d" UTC)  # of SOURCE_DATE_EPOCH, where that is set
endif()
configure_file(${SOURCE}/host/verbs/commit.cpp.in ${OUTPUT} @ONLY)
