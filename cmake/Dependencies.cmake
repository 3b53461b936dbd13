# What nlcwfs links to. The installed package configuration contains these lines too, so that a
# project that uses the libraries finds the same packages: find_dependency and the loop below turn
# what is missing into nlcwfs_FOUND = FALSE and the reason.
include(CMakeFindDependencyMacro)
find_dependency(PkgConfig)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(Boost 1.74 COMPONENTS program_options)
find_dependency(TBB)
find_dependency(Ceres 2.0)
find_dependency(nlohmann_json 3.10)
find_dependency(fmt)
find_dependency(spdlog 1.9)
find_dependency(pagmo)
find_dependency(SQLite3)
pkg_check_modules(FFTW QUIET IMPORTED_TARGET fftw3)
pkg_check_modules(FFTWF QUIET IMPORTED_TARGET fftw3f)
# Not find_package: Debian has one CMake package of NLopt's C library and one of its C++ library
# under the same name.
pkg_check_modules(NLOPT QUIET IMPORTED_TARGET nlopt)
pkg_check_modules(CFITSIO QUIET IMPORTED_TARGET cfitsio)
foreach(library FFTW FFTWF NLOPT CFITSIO)
  if(NOT ${library}_FOUND)
    set(nlcwfs_FOUND FALSE)
    set(nlcwfs_NOT_FOUND_MESSAGE "pkg-config does not find ${library}.")
    return()
  endif()
endforeach()
# Neither pkg-config nor dlib's CMake package, which name libraries that only dlib itself needs and
# whose development packages need not be there.
if(NOT TARGET nlcwfs::dlib)
  find_library(NLCWFS_DLIB_LIBRARY dlib)
  find_path(NLCWFS_DLIB_INCLUDE_DIR dlib/global_optimization/global_function_search.h)
  mark_as_advanced(NLCWFS_DLIB_LIBRARY NLCWFS_DLIB_INCLUDE_DIR)
  if(NOT NLCWFS_DLIB_LIBRARY OR NOT NLCWFS_DLIB_INCLUDE_DIR)
    set(nlcwfs_FOUND FALSE)
    set(nlcwfs_NOT_FOUND_MESSAGE "dlib is not found: its library or its headers.")
    return()
  endif()
  add_library(nlcwfs::dlib UNKNOWN IMPORTED)
  set_target_properties(
    nlcwfs::dlib PROPERTIES IMPORTED_LOCATION "${NLCWFS_DLIB_LIBRARY}"
                            INTERFACE_INCLUDE_DIRECTORIES "${NLCWFS_DLIB_INCLUDE_DIR}")
endif()
