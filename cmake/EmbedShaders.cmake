# Writes a C++ source with the text of GLSL files in it. Script mode:
#   cmake -DOUTPUT=file.cpp -DSHADERS="a.vert;b.frag" -P EmbedShaders.cmake
set(text "#include \"render/gl/shader_text.h\"\n\nnamespace ramus::render {\n\nconst std::map<std::string_view, std::string_view> kShaderSources{\n")
foreach(shader IN LISTS SHADERS)
  file(RELATIVE_PATH name ${CMAKE_CURRENT_LIST_DIR}/../shaders ${shader})
  file(READ ${shader} source)
  string(APPEND text "    {\"${name}\", R\"GLSL(${source})GLSL\"},\n")
endforeach()
string(APPEND text "};\n\n} // namespace ramus::render\n")
file(WRITE ${OUTPUT} "${text}")
