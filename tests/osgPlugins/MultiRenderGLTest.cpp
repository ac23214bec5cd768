// SPDX-License-Identifier: MIT
#include "StockPrograms.h"

#include <support/CompareImage.h>

#include <osgMultiRender/MixedScene.h>

#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

using osgMultiRender::MixedScene;

namespace
{

constexpr char Things[] = R"(#Inventor V2.1 ascii
Separator {
  Material { diffuseColor 0.8 0.6 0.3 }
  DEF PUMP-17 Separator { Cube { width 4 height 2 depth 1 } }
  DEF TANK-4 Separator { Translation { translation 4 0 0 } Cylinder { radius 1 height 3 } }
}
)";

class MultiRenderPlugin : public StockPrograms
{
protected:
    MultiRenderPlugin()
    {
        _width = 240;
        _height = 120;
    }

    const std::string _model = _folder.write("things.iv", Things);
};

} // namespace

TEST_F(MultiRenderPlugin, osgviewerMixesAModelBySuffix)
{
    const std::string mix = "points='-2,0,0',renderings=";
    const Picture plain = view(_model);
    const Picture phong = view(_model + ".(renderings=phong).multirender");
    const Picture gooch = view(_model + ".(" + mix + "gooch).multirender");
    const Picture both = view(_model + ".(" + mix + "'phong:0,0,2,4;gooch:2,4').multirender");
    ASSERT_TRUE(plain && phong && gooch && both);
    EXPECT_TRUE(differ(*plain, *gooch));
    EXPECT_TRUE(differ(*both, *gooch));
    EXPECT_TRUE(differ(*both, *phong));
    support::writeImage(*both, "multirenderBoth");
}

TEST_F(MultiRenderPlugin, aMixFileAndTheBracketsSayTheSame)
{
    const std::string file = _folder.write("a.mix", R"({
        "renderings": [{"name": "phong", "range": [0, 0, 2, 4], "uniforms": {"gloss": 7}},
                       {"file": "own.frag", "range": [2, 4]}],
        "points": [[-2, 0, 0]]})");
    const std::string own = _folder.write("own.frag", "void main() { gl_FragColor = "
                                                      "vec4(0.1, 0.7, 0.2, 1.0); }\n");
    const Picture byFile = view(_model + ".(mix=" + file + ").multirender");
    const Picture said = view(_model + ".(renderings='phong:0,0,2,4;" + own +
                              ":2,4',uniforms=phong.gloss=7,points='-2 0 0').multirender");
    ASSERT_TRUE(byFile && said);
    EXPECT_TRUE(support::CompareImage()(byFile, said, "multirenderFile"));
}

TEST_F(MultiRenderPlugin, anImageIsAQuadOfItsRatio)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(64, 32, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            image->setColor(osg::Vec4(x / 63.0f, y / 31.0f, (x / 8 + y / 8) % 2, 1.0f), unsigned(x),
                            unsigned(y));
    const std::string file = _folder.file("photo.png");
    ASSERT_TRUE(osgDB::writeImageFile(*image, file));
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(
        file + ".(renderings='sobel:0,0,0.4,0.6;sepia:0.4,0.6',points='0,0,0').multirender");
    auto* scene = dynamic_cast<MixedScene*>(node.get());
    ASSERT_TRUE(scene);
    EXPECT_NEAR(scene->getBound().radius(), 0.5 * std::sqrt(5.0), 1e-4);
    EXPECT_EQ(scene->getUniform(0, "imageSize"), (std::vector<double>{64, 32}));
    const Picture picture = view(file + ".(renderings='sobel:0,0,0.4,0.6;sepia:0.4,0.6',points='0,"
                                        "0,0',show=points).multirender");
    ASSERT_TRUE(picture);
    support::writeImage(*picture, "multirenderPhoto");
}

TEST_F(MultiRenderPlugin, aSavedSceneLooksTheSame)
{
    const std::string name =
        _model + ".(renderings='phong:0,0,2,4;gooch:2,4',points='-2,0,0').multirender";
    const Picture fresh = view(name);
    ASSERT_TRUE(fresh);
    for (const char* const format : {"osgt", "osgb", "osgx", "osg"})
    {
        const Picture saved = view(convert(name, _folder.file(std::string("saved.") + format)));
        ASSERT_TRUE(saved) << format;
        EXPECT_TRUE(support::CompareImage()(saved, fresh, std::string("multirender.") + format));
    }
}

TEST_F(MultiRenderPlugin, theFrameIsMixedInASecondPass)
{
    const std::string mix = "points='-2,0,0',renderings='sobel:0,0,1,2;sepia:1,2'";
    const Picture surfaces = view(_model + ".(" + mix + ").multirender");
    const Picture frame = view(_model + ".(" + mix + ",input=frame).multirender");
    const Picture labelled = view(_model + ".labels.(" + mix + ",input=frame).multirender");
    ASSERT_TRUE(surfaces && frame && labelled);
    EXPECT_TRUE(differ(*surfaces, *frame));
    EXPECT_TRUE(differ(*labelled, *frame));
    support::writeImage(*labelled, "multirenderFrameLabels");
}

TEST_F(MultiRenderPlugin, labelsLieOnTop)
{
    const std::string mixed = _model + ".(renderings='phong:0,0,2,4;gooch:2,4',points='-2,0,0')."
                                       "multirender";
    const Picture without = view(mixed), with = view(mixed + ".labels");
    const Picture none = view(mixed + ".(match=nothing).labels");
    const Picture within =
        view(_model + ".labels.(renderings='phong:0,0,2,4;gooch:2,4',points='-2,0,0').multirender");
    ASSERT_TRUE(without && with && none && within);
    EXPECT_TRUE(differ(*without, *with));
    EXPECT_TRUE(support::CompareImage()(none, without, "multirender.unlabelled"));
    EXPECT_TRUE(support::CompareImage()(within, with, "multirender.nested"));
    support::writeImage(*with, "multirenderLabels");
}

TEST_F(MultiRenderPlugin, wrongSettingsAreOneClearLine)
{
    const auto said = [&](const std::string& settings)
    {
        const osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readNode(
            _model + ".(" + settings + ").multirender", nullptr);
        EXPECT_FALSE(result.success()) << settings;
        return result.message();
    };
    EXPECT_NE(said("renderings=phong,mode=line")
                  .find("multirender: setting 'mode=line': 'line' is "
                        "none of points, polyline, loop"),
              std::string::npos);
    EXPECT_NE(said("points='0,0,0'")
                  .find("multirender: no rendering is named; say mix=<file> or "
                        "renderings=<name>"),
              std::string::npos);
    EXPECT_NE(said("mix=missing.mix").find("missing.mix"), std::string::npos);
}
