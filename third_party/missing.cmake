# Reports a missing dependency and the command that installs it.
function(tendril_missing what package)
    message(FATAL_ERROR
        "Tendril needs ${what}, which was not found.\n"
        "On Debian or Ubuntu:  apt-get install ${package}\n"
        "On other systems see third_party/README.md.")
endfunction()

function(tendril_require variable what package)
    if(NOT ${variable})
        tendril_missing("${what}" "${package}")
    endif()
endfunction()

function(tendril_require_file path)
    if(NOT EXISTS "${path}")
        message(FATAL_ERROR "${path} does not exist.")
    endif()
endfunction()
