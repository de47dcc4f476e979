# One way to say that something is not installed, and what to type.
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
