// SPDX-License-Identifier: MIT
#include "Subcommand.h"

#include <osgPagedTexture/TileExtract.h>

#include <cstdio>

namespace tilestore
{

namespace
{

constexpr char Help[] =
    R"(osgtilestore verify STORE
Reads a store to its end. Each byte of a packed one is compared with its checksum; tiles that are
files of their own are decoded. Prints a line for each damage; exit status 1 where there is any.

  --most N   lines at most, 1 to 1000000; default 100
  --json     {"problems": [...]}
  --help     this text
)";

int run(const Arguments& arguments)
{
    const std::string path = arguments.files(1, 1, "STORE")[0];
    const auto most = static_cast<std::size_t>(arguments.number("--most", 100, 1, 1000000));
    const auto problems = osgPagedTexture::verifyTileStore(path, most);
    if (arguments.isJson())
        print({{"problems", problems}});
    else if (problems.empty())
        std::printf("%s: no damage\n", path.c_str());
    for (const std::string& problem : problems)
        if (!arguments.isJson())
            std::printf("%s\n", problem.c_str());
    return problems.empty() ? 0 : 1;
}

} // namespace

const Subcommand VerifyCommand{"verify", "whether a store is damaged", Help, {{"--most"}}, run};

} // namespace tilestore
