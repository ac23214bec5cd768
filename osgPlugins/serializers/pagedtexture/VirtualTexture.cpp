// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualTexture.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

namespace
{

using osgPagedTexture::VirtualTexture;

bool checkStore(const VirtualTexture& texture)
{
    return !texture.getStore().empty();
}

/// It is looked for beside the file that names it.
bool readStore(osgDB::InputStream& in, VirtualTexture& texture)
{
    std::string store;
    in.readWrappedString(store);
    texture.setStore(store);
    texture.find(in.getOptions());
    return true;
}

bool writeStore(osgDB::OutputStream& out, const VirtualTexture& texture)
{
    out.writeWrappedString(texture.getStore());
    out << std::endl;
    return true;
}

} // namespace

// Not as an osg::Texture2D, whose image would go with it: that is made of the store.
REGISTER_OBJECT_WRAPPER(
    osgPagedTexture_VirtualTexture, new osgPagedTexture::VirtualTexture,
    osgPagedTexture::VirtualTexture,
    "osg::Object osg::StateAttribute osg::Texture osgPagedTexture::VirtualTexture")
{
    ADD_USER_SERIALIZER(Store);
}
