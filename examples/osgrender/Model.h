// SPDX-License-Identifier: MIT
#pragma once

#include <osg/ArgumentParser>
#include <osg/Node>

#include <string>
#include <vector>

namespace osgrender
{

/// What a command line names to be drawn.
struct ModelNames
{
    std::vector<std::string> files;  ///< Models, with their pseudo-loader suffixes.
    std::vector<std::string> images; ///< --image: on a quad.
    std::vector<std::string> fields; ///< --dem: as a height field.

    std::string text() const; ///< All of them, separated by spaces.
};

/// Takes the model names out of what osgViewer::Viewer left. Returns false and fills `error` when
/// there are none, or a switch is left that nobody knows.
bool takeModels(osg::ArgumentParser& arguments, ModelNames& names, std::string& error);

/// Reads all models. Null and `error` when one can't be read: a picture without it would be wrong.
osg::ref_ptr<osg::Node> readModels(const ModelNames& names, std::string& error);

/// What there is to draw.
struct ModelContents
{
    unsigned int drawables = 0;
    unsigned int programs = 0; ///< Different osg::Programs of the model's own.
    bool paged = false;        ///< Holds nodes that load more while it is drawn.
};

ModelContents examine(osg::Node& model);

} // namespace osgrender
