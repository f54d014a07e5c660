# libharu, Debian's libhpdf-dev: printable PDF patterns.
include(FindPackageHandleStandardArgs)
find_path(Haru_INCLUDE_DIR hpdf.h)
find_library(Haru_LIBRARY hpdf)
find_package_handle_standard_args(Haru REQUIRED_VARS Haru_INCLUDE_DIR Haru_LIBRARY)
if(Haru_FOUND AND NOT TARGET Haru::Haru)
    add_library(Haru::Haru UNKNOWN IMPORTED)
    set_target_properties(Haru::Haru PROPERTIES
        IMPORTED_LOCATION ${Haru_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Haru_INCLUDE_DIR})
endif()
