# What `cmake --install` puts where, below whatever prefix: the program finds its modules and scenes from where it
# stands itself. Component glint is all that is used, doc what is read.
set(data share/glint)
set(repository ${PROJECT_SOURCE_DIR})
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME glint)

install(TARGETS glint RUNTIME DESTINATION bin)
install(DIRECTORY ${repository}/presets DESTINATION ${data} FILES_MATCHING PATTERN *.toml PATTERN *.png)
install(DIRECTORY ${repository}/fragments DESTINATION ${data} FILES_MATCHING PATTERN *.frag PATTERN new EXCLUDE)
install(DIRECTORY ${manuals}/ DESTINATION share/man/man1)
install(FILES shell/glint.bash DESTINATION share/bash-completion/completions RENAME glint)
install(FILES shell/_glint DESTINATION share/zsh/site-functions)
install(FILES shell/glint.fish DESTINATION share/fish/vendor_completions.d)

# The pictures of presets are the browser's gallery, and the pages'.
file(GLOB presets RELATIVE ${repository}/presets CONFIGURE_DEPENDS ${repository}/presets/*.toml)
foreach(preset ${presets})
    string(REPLACE .toml .jpg picture ${preset})
    list(APPEND gallery ${repository}/docs/pictures/${picture})
endforeach()
file(GLOB_RECURSE pictures CONFIGURE_DEPENDS ${repository}/docs/pictures/*)
list(REMOVE_ITEM pictures ${gallery})
install(FILES ${gallery} DESTINATION ${data}/docs/pictures OPTIONAL)
foreach(picture ${pictures})
    cmake_path(GET picture PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${repository})
    install(FILES ${picture} DESTINATION ${data}/${folder} COMPONENT doc)
endforeach()
file(GLOB pages CONFIGURE_DEPENDS ${repository}/docs/*.md)
file(GLOB pages_of_scenes CONFIGURE_DEPENDS ${repository}/docs/scenes/*.md)
install(FILES ${repository}/README.md ${repository}/LICENSE DESTINATION share/doc/glint COMPONENT doc)
install(FILES ${repository}/tests/fragments/bars.md DESTINATION share/doc/glint/tests/fragments COMPONENT doc)
install(FILES ${pages} DESTINATION share/doc/glint/docs COMPONENT doc)
install(FILES ${pages_of_scenes} DESTINATION share/doc/glint/docs/scenes COMPONENT doc)
file(CREATE_LINK ../../../glint/docs/pictures ${CMAKE_CURRENT_BINARY_DIR}/pictures SYMBOLIC)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pictures DESTINATION share/doc/glint/docs COMPONENT doc)

if(GLINT_WINDOW)
    install(FILES desktop/glint.desktop DESTINATION share/applications)
    install(FILES desktop/glint.xml DESTINATION share/mime/packages)
    foreach(size 48 64 128 256)
        install(FILES desktop/icons/${size}x${size}.png DESTINATION share/icons/hicolor/${size}x${size}/apps
            RENAME glint.png)
    endforeach()
endif()

include(deb/deb.cmake)
