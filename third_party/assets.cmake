# Embeds the shaders, the fonts and the labs' cards and presets in the program, which then runs from any folder. embed.cmake
# writes each as the elements of an array, which every compiler reads.
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

set(asset_arrays "")
set(asset_table "")
set(asset_bytes "")
foreach(path IN LISTS asset_files)
    tendril_require_file(${path})
    get_filename_component(name ${path} NAME)
    if(path IN_LIST asset_data)
        get_filename_component(folder ${path} DIRECTORY)
        get_filename_component(folder ${folder} NAME)
        set(name "${folder}/${name}")
    endif()
    string(MAKE_C_IDENTIFIER "asset_${name}" symbol)
    set(bytes ${CMAKE_CURRENT_BINARY_DIR}/assets/${symbol}.inc)
    add_custom_command(OUTPUT ${bytes} DEPENDS ${path} ${CMAKE_CURRENT_SOURCE_DIR}/embed.cmake
        COMMAND ${CMAKE_COMMAND} -DFROM=${path} -DTO=${bytes} -P ${CMAKE_CURRENT_SOURCE_DIR}/embed.cmake)
    list(APPEND asset_bytes ${bytes})
    string(APPEND asset_arrays "const unsigned char ${symbol}[] = {\n#include \"assets/${symbol}.inc\"\n};\n")
    string(APPEND asset_table "    {\"${name}\", ${symbol}},\n")
endforeach()
configure_file(assets.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/assets.cpp @ONLY)

add_library(tendril_assets STATIC ${CMAKE_CURRENT_BINARY_DIR}/assets.cpp ${asset_bytes})
target_include_directories(tendril_assets PUBLIC ${PROJECT_SOURCE_DIR} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
target_link_libraries(tendril_assets PRIVATE tendril_warnings)
