// SPDX-License-Identifier: MIT
#pragma once

#include "TileStoreRun.h"

#include <support/TemporaryFolder.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

inline std::string bytesOf(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder of photographs, and a store of them.
class PhotographStore
{
public:
    PhotographStore()
    {
        std::filesystem::create_directories(_folder.file("photos/north"));
        for (int i = 0; i < 12; ++i)
        {
            write(std::to_string(i), i);
        }
        write("north/1", 77);
    }
    std::string file(const std::string& name) const { return _folder.file(name); }
    std::string photos() const { return _folder.file("photos"); }
    std::string photo(const std::string& name) const { return photos() + "/" + name + ".ppm"; }
    std::string store() const { return _folder.file("photos.tiles"); }
    void write(const std::string& name, int seed) const
    {
        std::ofstream file(photo(name), std::ios::binary);
        file << "P6\n120 90\n255\n";
        for (int i = 0; i < 120 * 90 * 3; ++i)
        {
            file.put(char((i * (seed + 3) + (i >> 8) * seed) % 251));
        }
    }
    support::ProcessResult build(const std::string& store,
                                 const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> words{"build",       photos(), "--store",  store, "--json",
                                       "--tile-side", "40",     "--border", "4"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }

private:
    support::TemporaryFolder _folder;
};
