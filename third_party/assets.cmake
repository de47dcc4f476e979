# Embeds the shaders, the fonts and the labs' cards and presets in the program, which then runs from any folder. The
# assembler's .incbin copies the files unchanged, as fast for a font as for a line of text.
find_path(TENDRIL_FONT_FOLDER Roboto-Regular.ttf
    PATHS /usr/share/fonts/truetype/roboto/unhinted/RobotoTTF /usr/share/fonts/truetype/roboto/unhinted
          /usr/share/fonts/truetype/roboto
    DOC "The folder of Roboto-Regular.ttf and Roboto-Medium.ttf")
mark_as_advanced(TENDRIL_FONT_FOLDER)
tendril_require(TENDRIL_FONT_FOLDER "the font Roboto" fonts-roboto-unhinted)

file(GLOB asset_shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/*.vert
     ${PROJECT_SOURCE_DIR}/shaders/*.frag ${PROJECT_SOURCE_DIR}/shaders/*.glsl)
# Cards of things to try and presets, for each lab that has any: "rope/cards.json".
file(GLOB asset_data CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/app/labs/*/cards.json ${PROJECT_SOURCE_DIR}/app/labs/*/presets.json)
set(asset_files ${asset_shaders} ${asset_data} ${TENDRIL_FONT_FOLDER}/Roboto-Regular.ttf ${TENDRIL_FONT_FOLDER}/Roboto-Medium.ttf)

set(asset_blobs "")
set(asset_table "")
set(asset_index 0)
foreach(path IN LISTS asset_files)
    tendril_require_file(${path})
    get_filename_component(name ${path} NAME)
    if(path IN_LIST asset_data)
        get_filename_component(folder ${path} DIRECTORY)
        get_filename_component(folder ${folder} NAME)
        set(name "${folder}/${name}")
    endif()
    set(symbol "tendril_asset_${asset_index}")
    math(EXPR asset_index "${asset_index} + 1")
    string(APPEND asset_blobs "TENDRIL_ASSET(${symbol}, \"${path}\")\n")
    string(APPEND asset_table "    {\"${name}\", ${symbol}_begin, ${symbol}_end},\n")
endforeach()
configure_file(assets.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/assets.cpp @ONLY)
# The compiler cannot see through .incbin, so state the object's dependencies.
set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/assets.cpp PROPERTIES OBJECT_DEPENDS "${asset_files}")

add_library(tendril_assets STATIC ${CMAKE_CURRENT_BINARY_DIR}/assets.cpp)
# A compiler cache does not track what .incbin reads and would return stale assets.
set_target_properties(tendril_assets PROPERTIES CXX_COMPILER_LAUNCHER "")
target_include_directories(tendril_assets PUBLIC ${PROJECT_SOURCE_DIR})
target_link_libraries(tendril_assets PRIVATE tendril_warnings)
