# Packages of what host/install.cmake installs: glint, or glint-headless where the window is left out, and glint-doc.
# host/deb/make builds them all.
set(CPACK_PACKAGE_CONTACT "Glint contributors <glint@packages.invalid>" CACHE STRING "Maintainer of the packages")
set(package glint)
if(NOT GLINT_WINDOW)
    set(package glint-headless)
endif()

execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} -c safe.directory=* log -1 --abbrev=12 "--format=%h;%cD"
    OUTPUT_VARIABLE words OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT words)
    execute_process(COMMAND date -R OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(words "unknown;${date}")
endif()
list(POP_FRONT words commit date)
configure_file(${CMAKE_CURRENT_LIST_DIR}/changelog.in changelog @ONLY)
execute_process(COMMAND gzip -9nkf ${CMAKE_CURRENT_BINARY_DIR}/changelog)
set(papers ${CMAKE_CURRENT_LIST_DIR}/copyright ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
install(FILES ${papers} DESTINATION share/doc/${package})
install(FILES ${papers} DESTINATION share/doc/glint-doc COMPONENT doc)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME glint)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL glint doc)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)

# shlibdeps sees what is linked; the driver, which is loaded by name, it does not.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_GLINT_PACKAGE_NAME ${package})
set(CPACK_DEBIAN_GLINT_PACKAGE_DEPENDS "libegl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_GLINT_PACKAGE_RECOMMENDS ffmpeg)
set(CPACK_DEBIAN_GLINT_PACKAGE_SUGGESTS "glint-doc, gnuplot-nox, glslang-tools, spirv-tools")
set(what_it_is "Glint is a Shadertoy for one's own machine: a GLSL file is a scene,
each uniform in it can become a slider, and a preset keeps a look.
The same file is drawn")
if(GLINT_WINDOW)
    string(APPEND CPACK_DEBIAN_GLINT_PACKAGE_DEPENDS ", libglx-mesa0")
    set(CPACK_DEBIAN_GLINT_PACKAGE_CONFLICTS glint-headless)
    set(CPACK_DEBIAN_GLINT_PACKAGE_REPLACES glint-headless)
    set(CPACK_DEBIAN_GLINT_DESCRIPTION "playground for shaders, in a window and to films
${what_it_is} in a window, and to pictures and films.")
else()
    set(CPACK_DEBIAN_GLINT_PACKAGE_CONFLICTS glint)
    set(CPACK_DEBIAN_GLINT_PACKAGE_REPLACES glint)
    set(CPACK_DEBIAN_GLINT_PACKAGE_PROVIDES glint)
    set(CPACK_DEBIAN_GLINT_DESCRIPTION "playground for shaders, for machines without a screen
${what_it_is} to pictures and films; this package has no window.")
endif()

set(CPACK_DEBIAN_DOC_PACKAGE_NAME glint-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DOC_PACKAGE_RECOMMENDS "glint | glint-headless")
set(CPACK_DEBIAN_DOC_DESCRIPTION "playground for shaders, its pages
${what_it_is} in a window, and to pictures and films.
These are its pages: how to write scenes, to export them, and to
measure what a shortcut costs. Most of their pictures come with glint.")
include(CPack)
