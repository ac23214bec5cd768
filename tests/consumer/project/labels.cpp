// SPDX-License-Identifier: MIT
// What an embedding application does: a LabelScene over a batch and a model, saved and read back.
#include <osgLabels/LabelKeys.h>
#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelScene.h>
#include <osgLabels/PrimitiveBatch.h>

#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <cstdio>

using osgLabels::LabelScene;

int main(int argc, char** argv)
{
    if (argc != 2)
        return std::fprintf(stderr, "usage: consumer_labels file.osgt\n"), 2;
    osgLabels::LabelSettings settings;
    std::string error;
    if (!setLabelOption(settings, "size", "0.3", error) || osgLabels::labelKeys().empty())
        return std::fprintf(stderr, "%s\n", error.c_str()), 1;
    osg::ref_ptr<LabelScene> scene = new LabelScene;
    scene->setSettings(settings);
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
    osgLabels::Primitive pump;
    pump.name = "P-101";
    batch->add(pump);
    batch->build();
    scene->addChild(batch);
    scene->addChild(new osg::ShapeDrawable(new osg::Sphere));
    if (!osgDB::writeNodeFile(*scene, argv[1]))
        return std::fprintf(stderr, "cannot write %s\n", argv[1]), 1;
    osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(argv[1]);
    auto* labels = dynamic_cast<LabelScene*>(read.get());
    if (!labels || labels->getSettingsText() != "size='0.3'" || labels->getNumChildren() != 2)
        return std::fprintf(stderr, "%s did not come back as it was written\n", argv[1]), 1;
    // The pseudo-loader, too, is found in the installation.
    osg::ref_ptr<osg::Node> wrapped =
        osgDB::readRefNodeFile(std::string(argv[1]) + ".(ink=#ff0000).labels");
    labels = dynamic_cast<LabelScene*>(wrapped.get());
    if (!labels || labels->getSettingsText() != "ink='#ff0000'")
        return std::fprintf(stderr, "no LabelScene of the suffix\n"), 1;
    return 0;
}
