// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualTexture.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

// Not as an osg::Texture2D, whose image would go with it: that is made of the store.
REGISTER_OBJECT_WRAPPER(
    osgPagedTexture_VirtualTexture, new osgPagedTexture::VirtualTexture,
    osgPagedTexture::VirtualTexture,
    "osg::Object osg::StateAttribute osg::Texture osgPagedTexture::VirtualTexture")
{
    ADD_STRING_SERIALIZER(Store, "");
}
