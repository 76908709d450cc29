# Writes a C++ source with the bytes of a font in it. Script mode:
#   cmake -DOUTPUT=file.cpp -DFONT=font.ttf -P EmbedFont.cmake
file(READ ${FONT} bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)" "\\1\n" bytes "${bytes}")
file(WRITE ${OUTPUT} "namespace ramus::render {\n\nextern const unsigned char kFontFile[];\nconst unsigned char kFontFile[] = {\n${bytes}\n};\n\n} // namespace ramus::render\n")
