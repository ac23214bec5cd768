// SPDX-License-Identifier: MIT
#include <osgMultiRender/PseudoLoader.h>

#include <support/NotifyCapture.h>
#include <support/TemporaryFolder.h>

#include <osg/Group>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <gtest/gtest.h>

using osgMultiRender::parseSettings;
using osgMultiRender::Settings;
using osgMultiRender::settingsOfKit;
using osgMultiRender::splitPseudoName;

namespace
{

using Parts = std::pair<std::string, std::string>;

Parts split(const std::string& name)
{
    Parts parts;
    splitPseudoName(name, parts.first, parts.second);
    return parts;
}

Settings parsed(const std::string& text)
{
    Settings settings;
    std::string error;
    EXPECT_TRUE(parseSettings(text, settings, error)) << error;
    return settings;
}

std::string errorOf(const std::string& text)
{
    Settings settings;
    std::string error;
    EXPECT_FALSE(parseSettings(text, settings, error)) << text;
    return error;
}

Settings ofKit(const std::string& options)
{
    Settings settings;
    std::string error;
    EXPECT_TRUE(settingsOfKit(options, "labels", settings, error)) << error;
    return settings;
}

/// A loader whose group tells the settings that it got.
class EchoLoader : public osgMultiRender::PseudoLoader
{
public:
    EchoLoader() : PseudoLoader("echotest", "for this test") {}
    const char* className() const override { return "EchoLoader"; }

protected:
    osg::ref_ptr<osg::Node> wrap(osg::Node& model, const Settings& settings,
                                 std::string& error) const override
    {
        if (settings.count("wrong"))
        {
            error = "setting 'wrong' is not known; there are right and left";
            return nullptr;
        }
        osg::ref_ptr<osg::Group> group = new osg::Group;
        for (const auto& [key, value] : settings)
            group->addDescription(key + "=" + value);
        group->addChild(&model);
        return group;
    }
};

/// A model on disk and the loader, registered while it lives.
class PseudoLoaderFile : public testing::Test
{
protected:
    void SetUp() override
    {
        _model =
            _folder.write("model.osgt", "#Ascii Scene\n#Version 162\n#Generator OpenSceneGraph "
                                        "3.6.5\n\nosg::Group {\n  UniqueID 1\n}\n");
        osgDB::Registry::instance()->addReaderWriter(_loader);
    }
    void TearDown() override { osgDB::Registry::instance()->removeReaderWriter(_loader); }

    osgDB::ReaderWriter::ReadResult read(const std::string& file, const std::string& options = "")
    {
        osg::ref_ptr<osgDB::Options> o = new osgDB::Options(options);
        return _loader->readNode(file, o);
    }

    support::TemporaryFolder _folder;
    std::string _model;
    osg::ref_ptr<EchoLoader> _loader = new EchoLoader;
};

} // namespace

TEST(PseudoName, parametersAreTheLastBracketAfterADot)
{
    EXPECT_EQ(split("cow.osg"), Parts("cow.osg", ""));
    EXPECT_EQ(split("cow.osg.(a=1)"), Parts("cow.osg", "a=1"));
    EXPECT_EQ(split("cow.osg.[a=1]"), Parts("cow.osg", "a=1"));
    EXPECT_EQ(split("cow.osg.()"), Parts("cow.osg", ""));
    EXPECT_EQ(split("x.iv.(match=(P|V).*,file=a/b.c).labels.(size=0.3)"),
              Parts("x.iv.(match=(P|V).*,file=a/b.c).labels", "size=0.3"));
    EXPECT_EQ(split("x.iv.(match=(P|V).*,file=a/b.c)"), Parts("x.iv", "match=(P|V).*,file=a/b.c"));
}

TEST(PseudoName, fileNamesThatEndInABracketAreLeftAlone)
{
    EXPECT_EQ(split("photo(1)"), Parts("photo(1)", ""));
    EXPECT_EQ(split("dir/scene (copy).osg"), Parts("dir/scene (copy).osg", ""));
    EXPECT_EQ(split("scene (2)"), Parts("scene (2)", ""));
    EXPECT_EQ(split("a)"), Parts("a)", ""));
    EXPECT_EQ(split(")"), Parts(")", ""));
    EXPECT_EQ(split("(a)"), Parts("(a)", ""));
    EXPECT_EQ(split("a.(b"), Parts("a.(b", ""));
    EXPECT_EQ(split(""), Parts("", ""));
    EXPECT_EQ(split(".(a=1)"), Parts("", "a=1"));
}

TEST(PseudoSettings, areWordsSeparatedByCommasOrSpaces)
{
    EXPECT_EQ(parsed(""), Settings());
    EXPECT_EQ(parsed(" , ,, "), Settings());
    EXPECT_EQ(parsed("a=1,b=2 c=3"), (Settings{{"a", "1"}, {"b", "2"}, {"c", "3"}}));
    EXPECT_EQ(parsed("flag"), (Settings{{"flag", "true"}}));
    EXPECT_EQ(parsed("Size=Big"), (Settings{{"size", "Big"}}));
    EXPECT_EQ(parsed("a="), (Settings{{"a", ""}}));
    EXPECT_EQ(parsed("a=b=c"), (Settings{{"a", "b=c"}}));
    EXPECT_EQ(parsed("a=1,a=2"), (Settings{{"a", "2"}}));
    EXPECT_EQ(parsed("match=(P|V).*,file=a/b.c"),
              (Settings{{"match", "(P|V).*"}, {"file", "a/b.c"}}));
    EXPECT_EQ(parsed("v=(1, 2, 3) w=[4,5]"), (Settings{{"v", "(1, 2, 3)"}, {"w", "[4,5]"}}));
}

TEST(PseudoSettings, quotesKeepCommasSpacesAndBrackets)
{
    EXPECT_EQ(parsed("text='a, b) c'"), (Settings{{"text", "a, b) c"}}));
    EXPECT_EQ(parsed("text=\"it's\" x=1"), (Settings{{"text", "it's"}, {"x", "1"}}));
    EXPECT_EQ(parsed("text=''"), (Settings{{"text", ""}}));
    EXPECT_EQ(parsed("text='it'\"'\"'s \"'"), (Settings{{"text", "it's \""}}));
}

TEST(PseudoSettings, brokenOnesAreErrorsWithThePosition)
{
    EXPECT_EQ(errorOf("a='x"), "quote that opens at character 3 of 'a='x' is not closed");
    EXPECT_EQ(errorOf("a=(x"), "bracket that opens at character 3 of 'a=(x' is not closed");
    EXPECT_EQ(errorOf("a=x)"), "closing bracket without an opening one at character 4 of 'a=x)'");
    EXPECT_EQ(errorOf("=1"), "setting without a name in '=1'");
}

TEST(PseudoOptions, onlyWordsOfTheKitCount)
{
    EXPECT_EQ(ofKit(""), Settings());
    EXPECT_EQ(ofKit("noTesselateLargePolygons dds_flip"), Settings());
    EXPECT_EQ(ofKit("labels.size=0.3 shadowvolume.lighting=off x=1"), (Settings{{"size", "0.3"}}));
    EXPECT_EQ(ofKit("Labels.Size=0.3"), (Settings{{"size", "0.3"}}));
    EXPECT_EQ(ofKit("labels.font=\"DejaVu Sans\" labels.match=(A|B).*"),
              (Settings{{"font", "DejaVu Sans"}, {"match", "(A|B).*"}}));
    EXPECT_EQ(ofKit("it's (somebody else's"), Settings()) << "others need not follow our quoting";
}

TEST_F(PseudoLoaderFile, readsTheModelAndPutsTheKitOverIt)
{
    auto result = read(_model + ".echotest");
    ASSERT_TRUE(result.validNode()) << result.message();
    EXPECT_EQ(result.getNode()->asGroup()->getNumChildren(), 1u);
    EXPECT_EQ(result.getNode()->getNumDescriptions(), 0u);
}

TEST_F(PseudoLoaderFile, readsAsAnObjectToo)
{
    EXPECT_TRUE(_loader->readObject(_model + ".echotest", nullptr).validNode());
}

TEST_F(PseudoLoaderFile, parenthesesOverrideTheOptionString)
{
    auto result = read(_model + ".(a=1,c='x y').echotest", "echotest.a=2 echotest.b=3 b=4");
    ASSERT_TRUE(result.validNode()) << result.message();
    EXPECT_EQ(result.getNode()->getDescriptions(),
              (osg::Node::DescriptionList{"a=1", "b=3", "c=x y"}));
}

TEST_F(PseudoLoaderFile, nestsInItself)
{
    auto result = read(_model + ".(inner).echotest.(outer).echotest");
    ASSERT_TRUE(result.validNode()) << result.message();
    EXPECT_EQ(result.getNode()->getDescription(0), "outer=true");
    EXPECT_EQ(result.getNode()->asGroup()->getChild(0)->getDescription(0), "inner=true");
}

TEST_F(PseudoLoaderFile, anEmptyNameIsAnError)
{
    for (const char* name : {".echotest", ".(a=1).echotest"})
    {
        auto result = read(name);
        EXPECT_TRUE(result.error());
        EXPECT_EQ(result.message(),
                  "echotest: no model before the suffix in '" + std::string(name) + "'");
    }
    EXPECT_TRUE(read(_model).notHandled()) << "a file without the suffix is not ours";
}

TEST_F(PseudoLoaderFile, theInnerResultComesBackUnchanged)
{
    auto missing = read(_folder.file("missing.osgt") + ".echotest");
    EXPECT_TRUE(missing.notFound()) << missing.statusMessage();
    auto unknown = read(_folder.file("model.nosuchformat") + ".echotest");
    EXPECT_FALSE(unknown.success());
}

TEST_F(PseudoLoaderFile, wrongSettingsAreErrorsOfTheKit)
{
    auto wrong = read(_model + ".(wrong=1).echotest");
    EXPECT_TRUE(wrong.error());
    EXPECT_EQ(wrong.message(), "echotest: setting 'wrong' is not known; there are right and left");
    auto broken = read(_model + ".(a='x).echotest");
    EXPECT_TRUE(broken.error());
    EXPECT_EQ(broken.message(),
              "echotest: quote that opens at character 3 of 'a='x' is not closed");
    auto options = read(_model + ".echotest", "echotest.a='x");
    EXPECT_TRUE(options.error());
}

TEST_F(PseudoLoaderFile, namesWithBracketsAreFound)
{
    const std::string odd =
        _folder.write("model (1).osgt", "#Ascii Scene\n#Version 162\n#Generator OpenSceneGraph "
                                        "3.6.5\n\nosg::Group {\n  UniqueID 1\n}\n");
    EXPECT_TRUE(read(odd + ".echotest").validNode());
    EXPECT_TRUE(read(odd + ".(a=1).echotest").validNode());
}
