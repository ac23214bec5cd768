// SPDX-License-Identifier: MIT
#include <osgLabels/TextFile.h>

#include <istream>
#include <sstream>

namespace osgLabels
{

std::string readTextFile(std::istream& in, std::string& content)
{
    std::ostringstream text;
    // An empty file fails to insert anything, and a folder opens, too, and can't be read.
    if (!in || (in.peek() != std::istream::traits_type::eof() && !(text << in.rdbuf())) || in.bad())
        return "cannot be read; does it exist?";
    content = text.str();
    if (content.compare(0, 2, "\xff\xfe") == 0 || content.compare(0, 2, "\xfe\xff") == 0)
        return "is UTF-16; save it as UTF-8";
    if (content.compare(0, 3, "\xef\xbb\xbf") == 0)
        content.erase(0, 3);
    return {};
}

} // namespace osgLabels
