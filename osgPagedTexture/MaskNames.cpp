// SPDX-License-Identifier: MIT
#include <osgPagedTexture/MaskNames.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

namespace osgPagedTexture
{

namespace
{

namespace fs = std::filesystem;

std::string folded(std::string name)
{
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return name;
}

/// The folder that all files are in.
fs::path commonFolder(const std::vector<Photo>& photos)
{
    fs::path common;
    bool first = true;
    for (const Photo& photo : photos)
    {
        if (photo.file.empty())
            continue;
        const fs::path folder = fs::path(photo.file).parent_path();
        if (first)
            common = folder;
        first = false;
        fs::path shared;
        for (auto a = common.begin(), b = folder.begin();
             a != common.end() && b != folder.end() && *a == *b; ++a, ++b)
            shared /= *a;
        common = shared;
    }
    return common;
}

/// What a photograph is called, the more exactly the higher `degree` is, up to 2.
std::string nameOf(const Photo& photo, std::size_t number, const fs::path& folder, int degree)
{
    if (photo.file.empty())
        return "photograph" + std::to_string(number + 1);
    const fs::path file(photo.file);
    if (degree == 0)
        return file.stem().string();
    if (degree == 1)
        return file.filename().string();
    return file.lexically_relative(folder).generic_string();
}

} // namespace

std::vector<std::string> namesOfPhotos(const std::vector<Photo>& photos)
{
    const fs::path folder = commonFolder(photos);
    std::vector<int> degrees(photos.size(), 0);
    std::vector<std::string> names(photos.size());
    // Each turn, those that share a name are called more exactly; last by their number.
    for (int turn = 0; turn < 4; ++turn)
    {
        std::map<std::string, std::size_t> counts;
        for (std::size_t i = 0; i < photos.size(); ++i)
        {
            names[i] = nameOf(photos[i], i, folder, std::min(degrees[i], 2));
            if (degrees[i] > 2)
                names[i] += "." + std::to_string(i + 1);
            ++counts[folded(names[i])];
        }
        for (std::size_t i = 0; i < photos.size(); ++i)
            degrees[i] += counts[folded(names[i])] > 1;
    }
    return names;
}

} // namespace osgPagedTexture
