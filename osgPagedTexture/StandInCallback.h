// SPDX-License-Identifier: MIT
#pragma once

#include <osgDB/Callbacks>

namespace osgPagedTexture
{

/// Gives images for those that a FileImages of the thread stands in for; hands all else on to
/// another callback, or to the Registry.
class StandInCallback : public osgDB::ReadFileCallback
{
public:
    using Result = osgDB::ReaderWriter::ReadResult;

    explicit StandInCallback(osgDB::ReadFileCallback* next) : _next(next) {}

    Result readImage(const std::string& name, const osgDB::Options* options) override;
    Result openArchive(const std::string& name, osgDB::ReaderWriter::ArchiveStatus status,
                       unsigned int hint, const osgDB::Options* options) override;
    Result readObject(const std::string& name, const osgDB::Options* options) override;
    Result readHeightField(const std::string& name, const osgDB::Options* options) override;
    Result readNode(const std::string& name, const osgDB::Options* options) override;
    Result readShader(const std::string& name, const osgDB::Options* options) override;
    Result readScript(const std::string& name, const osgDB::Options* options) override;

    osgDB::ReadFileCallback* getNext() const { return _next.get(); }

protected:
    ~StandInCallback() override = default;

private:
    const osg::ref_ptr<osgDB::ReadFileCallback> _next;
};

} // namespace osgPagedTexture
