// SPDX-License-Identifier: MIT
#include <osgLabels/LabelSource.h>

#include <support/TemporaryFolder.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ValueObject>
#include <osgDB/ReadFile>

#include <gtest/gtest.h>

#include <fstream>

using namespace osgLabels;

namespace
{

/// plant / PIPE-101 / geode / geometry, all but the named ones without a name.
struct Plant
{
    osg::ref_ptr<osg::Group> plant = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> pipe = new osg::MatrixTransform;
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;

    Plant()
    {
        plant->setName("plant");
        pipe->setName("PIPE-101");
        plant->addChild(pipe);
        pipe->addChild(geode);
        geode->addDrawable(geometry);
    }
    osg::NodePath path() const { return {plant.get(), pipe.get(), geode.get(), geometry.get()}; }
};

std::shared_ptr<const LabelSource> make(const LabelSourceSettings& settings)
{
    std::string error;
    auto source = LabelSource::create(settings, error);
    EXPECT_TRUE(source) << error;
    return source;
}

std::string textOf(const LabelSourceSettings& settings, const osg::NodePath& path)
{
    const auto source = make(settings);
    const auto found = source ? source->find(path) : std::nullopt;
    return found ? found->text : "(none)";
}

std::string errorOf(const LabelSourceSettings& settings)
{
    std::string error;
    EXPECT_FALSE(LabelSource::create(settings, error));
    return error;
}

class LabelFileTest : public testing::Test
{
protected:
    support::TemporaryFolder folder;

    std::string write(const std::string& name, const std::string& content)
    {
        const std::string path = folder.file(name);
        std::ofstream(path, std::ios::binary) << content;
        return path;
    }
    TextByName read(const std::string& name, const std::string& content)
    {
        TextByName texts;
        std::string error;
        EXPECT_TRUE(readLabelFile(write(name, content), texts, error)) << error;
        return texts;
    }
    /// The error without the folder.
    std::string errorOf(const std::string& name, const std::string& content)
    {
        TextByName texts{{"kept", {"kept", ""}}};
        std::string error;
        EXPECT_FALSE(readLabelFile(write(name, content), texts, error));
        EXPECT_EQ(texts.size(), 1u);
        return error.substr(std::min(error.size(), folder.file("").size()));
    }
};

} // namespace

TEST(LabelSourceTest, nearestNamedAncestorGivesTheText)
{
    const Plant scene;
    EXPECT_EQ(textOf({}, scene.path()), "PIPE-101");
    EXPECT_EQ(make({})->find(scene.path())->depth, 1u);
    scene.geometry->setName("flange");
    EXPECT_EQ(textOf({}, scene.path()), "flange");
}

TEST(LabelSourceTest, theNearestStyleFromTheNamedNodeUpCounts)
{
    const Plant scene;
    const auto style = [&] { return make({})->find(scene.path())->style; };
    EXPECT_EQ(style(), "");
    scene.plant->setUserValue("labelStyle", std::string("cold"));
    EXPECT_EQ(style(), "cold");
    EXPECT_EQ(make({})->ofName("TK-1", {scene.plant})->style, "cold");
    scene.pipe->setUserValue("labelStyle", std::string("hot"));
    EXPECT_EQ(style(), "hot");
    // The label is that of the pipe, with all that it consists of.
    scene.geode->setUserValue("labelStyle", std::string("parts"));
    EXPECT_EQ(style(), "hot");
    scene.pipe->setUserValue("labelStyle", std::string());
    EXPECT_EQ(style(), "") << "an empty one is none, and ends the search";
}

TEST(LabelSourceTest, madeUpNamesDoNotCount)
{
    const Plant scene;
    scene.geometry->setName(" \t");
    scene.geode->setName("Geode");
    EXPECT_EQ(textOf({}, scene.path()), "PIPE-101");
    // A texture's name on the Geode, as Inventor's reader gives it.
    scene.geometry->setName("");
    scene.geode->setName("rust");
    scene.geometry->getOrCreateStateSet()->setName("rust");
    EXPECT_EQ(textOf({}, scene.path()), "PIPE-101");
    scene.geometry->getStateSet()->setName("");
    EXPECT_EQ(textOf({}, scene.path()), "rust");
}

TEST(LabelSourceTest, withoutANameThereIsNoLabel)
{
    const Plant scene;
    scene.plant->setName("");
    scene.pipe->setName("");
    EXPECT_EQ(textOf({}, scene.path()), "(none)");
    EXPECT_EQ(textOf({}, {}), "(none)");
}

TEST(LabelSourceTest, matchPicksTheNearestThatMatches)
{
    const Plant scene;
    scene.geometry->setName("flange");
    LabelSourceSettings settings;
    settings.match = "^PIPE-(\\d+)";
    EXPECT_EQ(textOf(settings, scene.path()), "PIPE-101");
    settings.format = "pipe $1";
    EXPECT_EQ(textOf(settings, scene.path()), "pipe 101");
    settings.match = "^TANK";
    EXPECT_EQ(textOf(settings, scene.path()), "(none)");
}

TEST(LabelSourceTest, hugeNamesDoNotExhaustTheStack)
{
    const Plant scene;
    scene.geometry->setName(std::string(10'000'000, 'a'));
    LabelSourceSettings settings;
    settings.match = "(a|b)*c";
    EXPECT_EQ(textOf(settings, scene.path()), "(none)");
}

TEST(LabelSourceTest, descriptionsAndUserValuesGiveTexts)
{
    const Plant scene;
    scene.pipe->addDescription("");
    scene.pipe->addDescription("cold water");
    scene.plant->setUserValue("label", std::string("the plant"));
    scene.plant->setUserValue("pressure", 2.5);
    LabelSourceSettings settings;
    settings.from = LabelFrom::DESCRIPTION;
    EXPECT_EQ(textOf(settings, scene.path()), "cold water");
    settings.from = LabelFrom::VALUE;
    EXPECT_EQ(textOf(settings, scene.path()), "the plant");
    settings.value = "pressure";
    EXPECT_EQ(textOf(settings, scene.path()), "2.5");
    settings.value = "none";
    EXPECT_EQ(textOf(settings, scene.path()), "(none)");
    settings.value = "label";
    scene.geode->setUserValue("label", std::string());
    EXPECT_EQ(textOf(settings, scene.path()), "(none)"); // left out on purpose
    settings.from = LabelFrom::DESCRIPTION;
    settings.match = "plant";
    EXPECT_EQ(textOf(settings, scene.path()), "(none)");
}

TEST(LabelSourceTest, badSettingsAreExplained)
{
    LabelSourceSettings settings;
    settings.match = "(a";
    EXPECT_EQ(errorOf(settings).substr(0, 70),
              "osgLabels::LabelSource: match=(a is no ECMAScript regular expression (");
    settings.match = "";
    settings.format = "$1";
    EXPECT_EQ(errorOf(settings), "osgLabels::LabelSource: format=$1 needs match and from=name: it "
                                 "is made of what matched in the name");
    settings.format = "";
    settings.from = LabelFrom::TABLE;
    EXPECT_EQ(errorOf(settings),
              "osgLabels::LabelSource: from=table needs table=<file>.csv or .json");
    settings.table = "/no/such.csv";
    EXPECT_EQ(errorOf(settings),
              "osgLabels::LabelSource: /no/such.csv: cannot be read; does it exist?");
}

TEST_F(LabelFileTest, tableGivesTextsByName)
{
    const Plant scene;
    LabelSourceSettings settings;
    settings.from = LabelFrom::TABLE;
    settings.table = write("tags.csv", "PIPE-101,21 °C\nplant,Plant 3\n");
    EXPECT_EQ(textOf(settings, scene.path()), "21 °C");
    settings.table = write("tags.json", "{\"plant\": \"Plant 3\"}");
    EXPECT_EQ(textOf(settings, scene.path()), "Plant 3");
    settings.table = write("tags.json", "{\"plant\": \"Plant 3\", \"PIPE-101\": null}");
    EXPECT_EQ(textOf(settings, scene.path()), "(none)");
}

TEST_F(LabelFileTest, csvIsReadByRfc4180)
{
    const TextByName expected = {
        {"a", {"1", ""}}, {"b,c", {"say \"so\"", ""}}, {" d", {"two\nlines ", ""}}};
    EXPECT_EQ(read("t.csv", "a,1\r\n\"b,c\",\"say \"\"so\"\"\"\r\n\r\n d,\"two\nlines \"\r\n"),
              expected);
    EXPECT_EQ(read("t.CSV", "\xef\xbb\xbfName,Text\na,1"), (TextByName{{"a", {"1", ""}}}));
    EXPECT_EQ(read("t.csv", "a,1\na,1\n"), (TextByName{{"a", {"1", ""}}}));
    EXPECT_EQ(read("t.csv", ""), TextByName());
}

TEST_F(LabelFileTest, jsonIsReadAsObjectOrList)
{
    const TextByName expected = {
        {"a", {"1", ""}}, {"b", {"2.5", ""}}, {"c", {"", ""}}, {"d", {"true", ""}}};
    EXPECT_EQ(read("t.json", "{\"a\": \"1\", \"b\": 2.5, \"c\": null, \"d\": true}"), expected);
    EXPECT_EQ(read("t.json", "[{\"name\": \"a\", \"text\": \"1\", \"unit\": 5}]"),
              (TextByName{{"a", {"1", ""}}}));
}

TEST_F(LabelFileTest, tablesMaySayStyles)
{
    const TextByName expected = {{"a", {"1", "hot"}}, {"b", {"2", ""}}};
    EXPECT_EQ(read("t.csv", "Name,Text,Style\na,1,hot\nb,2,\n"), expected);
    EXPECT_EQ(read("t.json", "[{\"name\": \"a\", \"text\": \"1\", \"style\": \"hot\"},"
                             " {\"name\": \"b\", \"text\": \"2\"}]"),
              expected);
    EXPECT_EQ(errorOf("t.csv", "name,text,style\na,1\n"),
              "t.csv:2: a line has three columns, name, text and style, this one has 2; quote a "
              "text that has a comma: \"a,b\"");
    EXPECT_EQ(errorOf("t.csv", "name,text,style\na,1,hot\na,1,cold\n"),
              "t.csv:3: 'a' has the style 'hot' already; keep one of them");
    EXPECT_EQ(errorOf("t.json", "[{\"name\": \"a\", \"text\": \"1\", \"style\": []}]"),
              "t.json: the style of 'a' is a list or an object; it must be a string");
}

TEST_F(LabelFileTest, theTablesStyleWinsOverAUserValue)
{
    const Plant scene;
    scene.plant->setUserValue("labelStyle", std::string("cold"));
    LabelSourceSettings settings;
    settings.from = LabelFrom::TABLE;
    settings.table = write("tags.csv", "name,text,style\nPIPE-101,a,hot\nplant,b,\n");
    EXPECT_EQ(make(settings)->find(scene.path())->style, "hot");
    scene.pipe->setName("");
    EXPECT_EQ(make(settings)->find(scene.path())->style, "cold");
    EXPECT_EQ(make(settings)->ofName("PIPE-101", {scene.plant})->style, "hot");
    EXPECT_EQ(make(settings)->ofName("plant", {scene.plant})->style, "cold");
    EXPECT_FALSE(make(settings)->ofName("pump", {scene.plant}));
}

TEST_F(LabelFileTest, brokenTablesNameFileLineCauseAndRemedy)
{
    EXPECT_EQ(errorOf("t.csv", "a,1\n\nb\n"),
              "t.csv:3: a line has two columns, name and text, this one has 1; quote a text that "
              "has a comma: \"a,b\"");
    EXPECT_EQ(errorOf("t.csv", "a;1\n"), "t.csv:1: a line has two columns, name and text, this one "
                                         "has 1; separate them by a comma");
    EXPECT_EQ(errorOf("t.csv", "a,1\n\"b\nc\",1,2\n"),
              "t.csv:2: a line has two columns, name and text, this one has 3; quote a text that "
              "has a comma: \"a,b\"");
    EXPECT_EQ(errorOf("t.csv", "a,1\nb,x\"y\n"),
              "t.csv:2: a quote inside of a field; double it, and quote the field: \"say "
              "\"\"so\"\"\"");
    EXPECT_EQ(errorOf("t.csv", "a,1\nb,\"y\n\n"),
              "t.csv:2: a quote is opened and never closed; close it");
    EXPECT_EQ(errorOf("t.csv", "a,1\na,2\n"),
              "t.csv:2: 'a' has the text '1' already; keep one of them");
    EXPECT_EQ(errorOf("t.csv", ",1\n"),
              "t.csv:1: the name is empty; give it one or take the line out");
    EXPECT_EQ(errorOf("t.csv", std::string("\xff\xfe"
                                           "a\0",
                                           4)),
              "t.csv: is UTF-16; save it as UTF-8");
    TextByName texts;
    std::string error;
    EXPECT_FALSE(readLabelFile(folder.file(""), texts, error));
    EXPECT_EQ(error, folder.file("") + ": cannot be read; does it exist?");
    EXPECT_EQ(errorOf("t.txt", "a,1\n"), "t.txt: a table of labels is a .csv or a .json file");
    EXPECT_EQ(errorOf("t.json", "{\"a\": 1,\n \"b\" 2}").substr(0, 18), "t.json:2: no JSON:");
    EXPECT_EQ(errorOf("t.json", "{\"a\": [1]}"),
              "t.json: the text of 'a' is a list or an object; it must be a string");
    EXPECT_EQ(errorOf("t.json", "[{\"name\": \"a\", \"text\": \"1\"}, 5]"),
              "t.json: entry 1 of the list is no {\"name\": …, \"text\": …} of two strings");
    EXPECT_EQ(errorOf("t.json", "5"), "t.json: neither an object {\"name\": \"text\"} nor a list "
                                      "of {\"name\": …, \"text\": …}");
    EXPECT_EQ(errorOf("t.json", "").substr(0, 18), "t.json:1: no JSON:");
}

TEST_F(LabelFileTest, deeplyNestedJsonIsNoCrash)
{
    EXPECT_NE(errorOf("t.json", std::string(100'000, '[')), "");
}

TEST_F(LabelFileTest, namesOfInventorFilesAreThoseOfTheirNodes)
{
    const std::string path = write("t.iv", R"(#Inventor V2.1 ascii
DEF PLANT Separator {
  DEF PIPE-101 Separator { Cylinder {} }
  Separator { DEF rust Texture2 { image 1 1 3 0xff0000 } Cube {} }
  DEF TANK Separator { Translation { translation 3 0 0 } DEF SHELL Sphere {} }
})");
    const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(path);
    ASSERT_TRUE(model);
    struct Texts : public osg::NodeVisitor
    {
        std::shared_ptr<const LabelSource> source = make({});
        std::vector<std::string> texts;
        Texts() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
        void apply(osg::Drawable&) override
        {
            const auto found = source->find(getNodePath());
            texts.push_back(found ? found->text : "(none)");
        }
    } texts;
    model->accept(texts);
    EXPECT_EQ(texts.texts, (std::vector<std::string>{"PIPE-101", "PLANT", "SHELL"}));
}
