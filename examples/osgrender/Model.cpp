// SPDX-License-Identifier: MIT
#include "Model.h"

#include <osg/Drawable>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Program>
#include <osg/ProxyNode>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <set>

namespace osgrender
{

namespace
{

class Examiner : public osg::NodeVisitor
{
public:
    Examiner() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        const osg::StateSet* state = node.getStateSet();
        const auto* program = state ? static_cast<const osg::Program*>(
                                          state->getAttribute(osg::StateAttribute::PROGRAM))
                                    : nullptr;
        if (program)
            _programs.insert(program);
        contents.paged |=
            dynamic_cast<osg::PagedLOD*>(&node) || dynamic_cast<osg::ProxyNode*>(&node);
        contents.drawables += node.asDrawable() != nullptr;
        contents.programs = static_cast<unsigned int>(_programs.size());
        traverse(node);
    }

    ModelContents contents;

private:
    std::set<const osg::Program*> _programs;
};

osg::ref_ptr<osg::Node> readModel(const std::string& file, std::string& error)
{
    osgDB::Registry* registry = osgDB::Registry::instance();
    osgDB::ReaderWriter::ReadResult result = registry->readNode(file, registry->getOptions());
    osg::ref_ptr<osg::Node> node = result.takeNode();
    if (node)
    {
        if (node->getName().empty())
            node->setName(file);
        return node;
    }
    error = "model '" + file + "' can't be read";
    if (!result.message().empty())
        error += ": " + result.message();
    else if (result.notFound())
        error += ": it is not there";
    else if (result.notHandled())
    {
        const std::string extension = osgDB::getLowerCaseFileExtension(file);
        error += registry->getReaderWriterForExtension(extension)
                     ? ": the plugin for '." + extension + "' does not understand it"
                     : ": no plugin reads '." + extension + "'";
    }
    return nullptr;
}

/// Reads what only osgDB's own command line functions put into a scene.
osg::ref_ptr<osg::Node> readSpecial(const char* option, const std::string& file, std::string& error)
{
    std::string words[] = {"osgrender", option, file};
    char* argv[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    int argc = 3;
    osg::ArgumentParser arguments(&argc, argv);
    osg::ref_ptr<osg::Node> node =
        osgDB::readRefNodeFiles(arguments, osgDB::Registry::instance()->getOptions());
    if (!node)
        error = std::string(option) + " '" + file + "' can't be read";
    return node;
}

} // namespace

std::string ModelNames::text() const
{
    std::string all;
    for (const std::vector<std::string>* list : {&files, &images, &fields})
    {
        for (const std::string& name : *list)
            all += (all.empty() ? "" : " ") + name;
    }
    return all;
}

bool takeModels(osg::ArgumentParser& arguments, ModelNames& names, std::string& error)
{
    std::string file;
    while (arguments.read("--image", file))
        names.images.push_back(file);
    while (arguments.read("--dem", file))
        names.fields.push_back(file);
    for (int i = 1; i < arguments.argc(); ++i)
    {
        if (arguments.isOption(i))
        {
            error =
                std::string("unknown switch '") + arguments[i] + "'; osgrender --help lists all";
            return false;
        }
        names.files.push_back(arguments[i]);
    }
    if (names.text().empty())
        error = "no model given";
    return error.empty();
}

osg::ref_ptr<osg::Node> readModels(const ModelNames& names, std::string& error)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    const auto add = [&](const osg::ref_ptr<osg::Node>& node)
    {
        if (node)
            group->addChild(node);
        return node.valid();
    };
    for (const std::string& image : names.images)
    {
        if (!add(readSpecial("--image", image, error)))
            return nullptr;
    }
    for (const std::string& field : names.fields)
    {
        if (!add(readSpecial("--dem", field, error)))
            return nullptr;
    }
    for (const std::string& file : names.files)
    {
        if (!add(readModel(file, error)))
            return nullptr;
    }
    if (group->getNumChildren() == 1)
        return group->getChild(0);
    return group;
}

ModelContents examine(osg::Node& model)
{
    Examiner examiner;
    model.accept(examiner);
    return examiner.contents;
}

} // namespace osgrender
