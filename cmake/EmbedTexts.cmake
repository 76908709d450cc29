# Writes a C++ source with the text of files in it, as a map from their path below a folder. Script mode:
#   cmake -DOUTPUT=file.cpp -DFILES="a.vert;b.frag" -DFOLDER=shaders -DMAP=ramus::render::kShaderSources
#         -DHEADER=render/gl/shader_text.h -P EmbedTexts.cmake
string(REGEX REPLACE "::[^:]*$" "" namespace ${MAP})
string(REGEX REPLACE ".*::" "" name ${MAP})
set(text "#include \"${HEADER}\"\n\nnamespace ${namespace} {\n\nconst std::map<std::string_view, std::string_view> ${name}{\n")
foreach(file IN LISTS FILES)
  file(RELATIVE_PATH path ${FOLDER} ${file})
  file(READ ${file} source)
  string(APPEND text "    {\"${path}\", R\"TEXT(${source})TEXT\"},\n")
endforeach()
string(APPEND text "};\n\n} // namespace ${namespace}\n")
file(WRITE ${OUTPUT} "${text}")
