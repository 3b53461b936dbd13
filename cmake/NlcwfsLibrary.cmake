# nlcwfs_library(NAME SOURCES... LINK ...): one library per folder, with the project's warnings.
set(NLCWFS_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                    -Wnon-virtual-dtor -Woverloaded-virtual)
if(NLCWFS_WARNINGS_AS_ERRORS)
  list(APPEND NLCWFS_WARNINGS -Werror)
endif()

# nlcwfs_compile_fast(TARGET OPTIMIZATION): for code that has no hot loops and takes longest to compile.
# Several files are compiled at once, so that their helpers must have different names; the presets but
# release compile each alone, so that it is known to include what it uses.
function(nlcwfs_compile_fast target optimization)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${optimization}>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${NLCWFS_JOINED_COMPILATION}
                                             UNITY_BUILD_BATCH_SIZE 4)
endfunction()

function(nlcwfs_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(nlcwfs_${name} STATIC ${ARG_SOURCES})
  add_library(nlcwfs::${name} ALIAS nlcwfs_${name})
  set_target_properties(nlcwfs_${name} PROPERTIES EXPORT_NAME ${name}
                                                  POSITION_INDEPENDENT_CODE ON)
  target_compile_features(nlcwfs_${name} PUBLIC cxx_std_20)
  target_compile_options(nlcwfs_${name} PRIVATE ${NLCWFS_WARNINGS})
  target_include_directories(
    nlcwfs_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                          $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/nlcwfs>)
  target_link_libraries(nlcwfs_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  install(TARGETS nlcwfs_${name} EXPORT nlcwfsTargets)
  install(
    DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nlcwfs/${name}
    FILES_MATCHING
    PATTERN "*.hpp"
    PATTERN "ranks.hpp" EXCLUDE # the program's own
    PATTERN "*-[0-9]*" EXCLUDE) # runs that were written into results/
endfunction()
