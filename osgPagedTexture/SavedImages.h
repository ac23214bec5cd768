// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

namespace osgPagedTexture
{

/// While it lives, what osgDB writes of paged textures is what a reader gets back without paging:
/// pictures that came in the model are in it again, and those of files are named, or read where the
/// options say that files hold the data ("WriteImageHint=IncludeData", "inlineTexturesInIVEFile",
/// "OutputTextureFiles" and others). They nest; at the last one's end the Registry is as it was. A
/// WriteFileCallback that others have put into the Registry or into options stays in force.
class OSGPAGEDTEXTURE_EXPORT SavedImages
{
public:
    SavedImages();
    ~SavedImages();
    SavedImages(const SavedImages&) = delete;
    SavedImages& operator=(const SavedImages&) = delete;
};

} // namespace osgPagedTexture
