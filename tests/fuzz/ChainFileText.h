// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/DdsFile.h>

/// The whole file of a chain.
inline std::string chainFileText(const osgPagedTexture::ContentHash& key,
                                 const osgPagedTexture::MipChain& chain)
{
    std::string text;
    osgPagedTexture::writeChainFile(key, chain,
                                    [&text](const void* bytes, std::size_t count)
                                    {
                                        text.append(static_cast<const char*>(bytes), count);
                                        return true;
                                    });
    return text;
}
