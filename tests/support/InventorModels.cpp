// SPDX-License-Identifier: MIT
#include <support/InventorModels.h>

#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace support
{

namespace
{

const std::filesystem::path Folder = "/usr/share/inventor/data/models";

/// Makes colors that are none black. Where a model has fewer materials than its binding asks for
/// (simple/indexedTriangleMesh.iv), osgdb_iv fills the array from memory that nobody wrote.
class TameColors : public osg::NodeVisitor
{
public:
    TameColors() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Geometry& geometry) override
    {
        auto* colors = dynamic_cast<osg::Vec4Array*>(geometry.getColorArray());
        for (unsigned int i = 0; colors && i < colors->size(); ++i)
            for (unsigned int c = 0; c < 4; ++c)
                if (float& value = (*colors)[i][c]; !(value >= 0.0f && value <= 1.0f))
                    value = 0.0f;
    }
};

} // namespace

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

std::string inventorCaseName(const std::string& path)
{
    std::string name =
        std::filesystem::path(path).lexically_relative(Folder).replace_extension().string();
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
    return name;
}

osg::ref_ptr<osg::Node> readInventorModel(const std::string& path)
{
    osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(path);
    TameColors tame;
    if (model)
        model->accept(tame);
    return model;
}

} // namespace support
