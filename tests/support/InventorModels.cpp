// SPDX-License-Identifier: MIT
#include <support/InventorModels.h>

#include <algorithm>
#include <filesystem>

namespace support
{

namespace
{
const std::filesystem::path Folder = "/usr/share/inventor/data/models";
}

std::vector<std::string> inventorModels()
{
    std::vector<std::string> models;
    std::error_code error;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(Folder, error))
    {
        if (entry.is_regular_file() && entry.path().extension() == ".iv")
            models.push_back(entry.path().string());
    }
    std::sort(models.begin(), models.end());
    return models;
}

std::string inventorModel(const std::string& name)
{
    return (Folder / name).string();
}

} // namespace support
