// SPDX-License-Identifier: MIT
#include <osgPagedTexture/StandInCallback.h>

#include <osgPagedTexture/FileImages.h>

namespace osgPagedTexture
{

using Result = StandInCallback::Result;

Result StandInCallback::readImage(const std::string& name, const osgDB::Options* options)
{
    if (FileImages* images = FileImages::current())
        if (const osg::ref_ptr<osg::Image> image = images->standIn(name, options))
            return Result(image.get());
    return _next ? _next->readImage(name, options)
                 : osgDB::ReadFileCallback::readImage(name, options);
}

Result StandInCallback::openArchive(const std::string& name,
                                    osgDB::ReaderWriter::ArchiveStatus status, unsigned int hint,
                                    const osgDB::Options* options)
{
    return _next ? _next->openArchive(name, status, hint, options)
                 : osgDB::ReadFileCallback::openArchive(name, status, hint, options);
}

Result StandInCallback::readObject(const std::string& name, const osgDB::Options* options)
{
    return _next ? _next->readObject(name, options)
                 : osgDB::ReadFileCallback::readObject(name, options);
}

Result StandInCallback::readHeightField(const std::string& name, const osgDB::Options* options)
{
    return _next ? _next->readHeightField(name, options)
                 : osgDB::ReadFileCallback::readHeightField(name, options);
}

Result StandInCallback::readNode(const std::string& name, const osgDB::Options* options)
{
    return _next ? _next->readNode(name, options)
                 : osgDB::ReadFileCallback::readNode(name, options);
}

Result StandInCallback::readShader(const std::string& name, const osgDB::Options* options)
{
    return _next ? _next->readShader(name, options)
                 : osgDB::ReadFileCallback::readShader(name, options);
}

Result StandInCallback::readScript(const std::string& name, const osgDB::Options* options)
{
    return _next ? _next->readScript(name, options)
                 : osgDB::ReadFileCallback::readScript(name, options);
}

} // namespace osgPagedTexture
