// SPDX-License-Identifier: MIT
#include <osgLabels/LabelScene.h>
#include <osgMultiRender/PseudoLoader.h>

#include <osgDB/Registry>

/// "model.iv.labels": shows the objects' names on their surfaces.
class ReaderWriterLabels : public osgMultiRender::PseudoLoader
{
public:
    ReaderWriterLabels()
        : PseudoLoader("labels", "Text on the surfaces of objects: model.ext.[(settings).]labels")
    {
    }

    const char* className() const override { return "osgLabels pseudo-loader"; }

protected:
    osg::ref_ptr<osg::Node> wrap(osg::Node& model, const osgMultiRender::Settings&,
                                 std::string&) const override
    {
        osg::ref_ptr<osgLabels::LabelScene> scene = new osgLabels::LabelScene;
        // The viewer's optimizer must not remove or merge the group.
        scene->setDataVariance(osg::Object::DYNAMIC);
        scene->addChild(&model);
        return scene;
    }
};

REGISTER_OSGPLUGIN(labels, ReaderWriterLabels)
