// SPDX-License-Identifier: MIT
#include "PackOptions.h"
#include "Subcommand.h"

#include <cstdio>

namespace tilestore
{

namespace
{

using namespace osgPagedTexture;

constexpr char Help[] =
    R"(osgtilestore compact STORE
Writes a packed store anew without its dead bytes, which updates leave. The file is then equal to
that of a full build, byte for byte. Programs that have the store open keep what they see. Needs
room for a second file meanwhile.

  --wait S   seconds to wait for another program that writes the store, 0 to 86400; default 0
  --json     bytes before and after
  --help     this text
)";

int run(const Arguments& arguments)
{
    const std::string path = arguments.files(1, 1, "STORE")[0];
    const std::uint64_t before = TilePackReader(path).getInfo().committedBytes;
    compactTilePack(path, packOptionsOf(arguments));
    const std::uint64_t after = TilePackReader(path).getInfo().committedBytes;
    if (arguments.isJson())
        print({{"bytesBefore", before}, {"bytes", after}});
    else
        std::printf("%s: %s, before %s\n", path.c_str(), byteText(after).c_str(),
                    byteText(before).c_str());
    return 0;
}

} // namespace

const Subcommand CompactCommand{
    "compact", "a packed store without dead bytes", Help, {{"--wait"}}, run};

} // namespace tilestore
