// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

namespace osgrender
{

/// One render of a script.
struct ScriptLine
{
    std::string place;              ///< "scenes.txt:12", the first line of it.
    std::vector<std::string> words; ///< As a shell would split them.
    std::string error;              ///< Why it can't be run; empty: it can.
};

/// Reads a script: one render a line. `#` at the start of a word begins a comment, a backslash at
/// the end of a line joins the next, '…' keeps everything as it is, "…" keeps spaces, and ${NAME}
/// stands for a definition or else an environment variable. A line with a broken quote or an
/// unknown name comes back with its error. Returns false and fills `error` when the file can't be
/// read.
bool readScript(const std::string& file, const std::map<std::string, std::string>& definitions,
                std::vector<ScriptLine>& lines, std::string& error);

/// Splits one line as readScript() does. Returns why it can't, else "".
std::string splitWords(const std::string& line,
                       const std::map<std::string, std::string>& definitions,
                       std::vector<std::string>& words);

} // namespace osgrender
