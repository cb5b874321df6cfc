# Writes the bytes of INPUT as a C++ array: OUTPUT_DIR/VARIABLE.{h,cpp}.
file(READ ${INPUT} hex HEX)
string(LENGTH "${hex}" digits)
math(EXPR size "${digits} / 2")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${hex}")
# 64 bytes a line.
string(REGEX REPLACE "(................................................................................................................................................................................................................................................................)" "\\1\"\n\"" bytes "${bytes}")
file(WRITE ${OUTPUT_DIR}/${VARIABLE}.h.new
     "#pragma once\n#include <string_view>\nnamespace skel::embedded {\nextern const std::string_view ${VARIABLE};\n}\n")
file(WRITE ${OUTPUT_DIR}/${VARIABLE}.cpp.new
     "#include \"${VARIABLE}.h\"\nnamespace skel::embedded {\nconst std::string_view ${VARIABLE}(\n\"${bytes}\",\n${size});\n}\n")
foreach(ext h cpp)
  file(RENAME ${OUTPUT_DIR}/${VARIABLE}.${ext}.new ${OUTPUT_DIR}/${VARIABLE}.${ext})
endforeach()
