// SPDX-License-Identifier: MIT
#include "PhotoChoice.h"

#include "Arguments.h"

#include <filesystem>

namespace tilestore
{

std::vector<std::size_t> choosePhotos(const std::vector<osgPagedTexture::Photo>& photos,
                                      const std::vector<std::string>& names,
                                      const std::vector<std::string>& wanted)
{
    std::vector<std::size_t> chosen;
    if (wanted.empty())
        for (std::size_t i = 0; i < photos.size(); ++i)
            chosen.push_back(i);
    for (const std::string& each : wanted)
    {
        std::error_code failure;
        const std::string path = std::filesystem::weakly_canonical(each, failure).string();
        const std::size_t before = chosen.size();
        for (std::size_t i = 0; i < photos.size(); ++i)
            if (each == names[i] || each == photos[i].name || path == photos[i].file ||
                each == std::filesystem::path(photos[i].file).filename())
                chosen.push_back(i);
        if (chosen.size() == before)
            throw UsageError("the model shows no photograph '" + each + "'");
    }
    return chosen;
}

} // namespace tilestore
