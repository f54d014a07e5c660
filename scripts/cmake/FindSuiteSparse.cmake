# Debian's SuiteSparse 5.12 ships neither a CMake config nor a pkg-config file.
# Defines SuiteSparse::cholmod, SuiteSparse::umfpack, SuiteSparse::amd and SuiteSparse::metis.
include(FindPackageHandleStandardArgs)
find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_path(Metis_INCLUDE_DIR metis.h)
foreach(part cholmod umfpack amd suitesparseconfig metis)
    find_library(SuiteSparse_${part}_LIBRARY ${part})
endforeach()
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS
    SuiteSparse_INCLUDE_DIR SuiteSparse_cholmod_LIBRARY SuiteSparse_umfpack_LIBRARY
    SuiteSparse_amd_LIBRARY SuiteSparse_suitesparseconfig_LIBRARY
    Metis_INCLUDE_DIR SuiteSparse_metis_LIBRARY)
if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::cholmod)
    foreach(part suitesparseconfig amd metis cholmod umfpack)
        add_library(SuiteSparse::${part} UNKNOWN IMPORTED)
        set_target_properties(SuiteSparse::${part} PROPERTIES
            IMPORTED_LOCATION ${SuiteSparse_${part}_LIBRARY}
            INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR};${Metis_INCLUDE_DIR}")
    endforeach()
    target_link_libraries(SuiteSparse::cholmod INTERFACE
        SuiteSparse::amd SuiteSparse::metis SuiteSparse::suitesparseconfig)
    target_link_libraries(SuiteSparse::umfpack INTERFACE SuiteSparse::cholmod SuiteSparse::amd)
endif()
