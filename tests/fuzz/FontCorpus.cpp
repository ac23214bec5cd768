// SPDX-License-Identifier: MIT
// FontCorpus <folder>: writes small fonts: some letters of those that are installed, with and
// without what joins them, and one of pixels.
#include <hb-subset.h>

#include <fstream>
#include <iostream>
#include <string>

namespace
{

void writeSubset(const std::string& font, const std::string& letters, const std::string& to)
{
    hb_blob_t* const blob = hb_blob_create_from_file(font.c_str());
    hb_face_t* const face = hb_face_create(blob, 0);
    hb_subset_input_t* const input = hb_subset_input_create_or_fail();
    for (const char letter : letters)
        hb_set_add(hb_subset_input_unicode_set(input), static_cast<unsigned char>(letter));
    if (letters.size() > 2)
        hb_set_add(hb_subset_input_unicode_set(input), 0x301); // combines
    if (hb_face_t* const subset = hb_subset_or_fail(face, input))
    {
        hb_blob_t* const bytes = hb_face_reference_blob(subset);
        unsigned int size = 0;
        const char* const data = hb_blob_get_data(bytes, &size);
        if (size > 0 && hb_face_get_glyph_count(face) > 0)
            std::ofstream(to, std::ios::binary).write(data, size);
        hb_blob_destroy(bytes);
        hb_face_destroy(subset);
    }
    hb_subset_input_destroy(input);
    hb_face_destroy(face);
    hb_blob_destroy(blob);
}

constexpr char Pixels[] = R"(STARTFONT 2.1
FONT -x-f-medium-r-normal--8-80-75-75-c-80-iso10646-1
SIZE 8 75 75
FONTBOUNDINGBOX 8 8 0 -2
STARTPROPERTIES 2
FONT_ASCENT 6
FONT_DESCENT 2
ENDPROPERTIES
CHARS 2
STARTCHAR A
ENCODING 65
SWIDTH 1000 0
DWIDTH 8 0
BBX 8 8 0 -2
BITMAP
18
24
42
7E
42
42
00
00
ENDCHAR
STARTCHAR e
ENCODING 101
SWIDTH 1000 0
DWIDTH 8 0
BBX 8 8 0 -2
BITMAP
00
00
3C
7E
40
3C
00
00
ENDCHAR
ENDFONT
)";

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "FontCorpus: name the folder to write to\n";
        return 2;
    }
    const std::string folder = std::string(argv[1]) + "/";
    for (const char* const name : {"Sans", "SansMono", "Serif", "MathTeXGyre"})
        for (const char* const letters : {"A", "Aefi"})
            writeSubset("/usr/share/fonts/truetype/dejavu/DejaVu" + std::string(name) + ".ttf",
                        letters, folder + name + letters + ".ttf");
    std::ofstream(folder + "pixels.bdf", std::ios::binary) << Pixels;
    return 0;
}
