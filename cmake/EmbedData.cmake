# Writes a file of bytes into a C++ file, so that the library needs no files at run time.
#
#   cmake -DOUTPUT=embedded.cpp -DINPUT=table.bin -DHEADER=scene/table.h -DFUNCTION=table_bytes -P EmbedData.cmake
#
# The result defines std::span<const unsigned char> FUNCTION() of namespace sundog, which HEADER declares.
cmake_minimum_required(VERSION 3.25)

file(READ "${INPUT}" digits HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${digits}")
get_filename_component(name "${INPUT}" NAME)

file(WRITE "${OUTPUT}" "// Generated from ${name} by cmake/EmbedData.cmake.
#include \"${HEADER}\"

namespace sundog {

std::span<const unsigned char> ${FUNCTION}()
{
    static constexpr unsigned char bytes[] = {${bytes}};
    return bytes;
}

} // namespace sundog
")
