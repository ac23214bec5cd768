// SPDX-License-Identifier: MIT
#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace
{

std::string contentOf(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// Drawables by the name of the picture of texture unit 0, and pictures of any unit.
class Surfaces : public osg::NodeVisitor
{
public:
    Surfaces() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Drawable& drawable) override
    {
        const osg::StateSet* state = drawable.getStateSet();
        for (unsigned int unit = 0; state && unit < state->getNumTextureAttributeLists(); ++unit)
            if (const auto* texture = dynamic_cast<const osg::Texture2D*>(
                    state->getTextureAttribute(unit, osg::StateAttribute::TEXTURE)))
            {
                EXPECT_TRUE(texture->getImage() && texture->getImage()->data());
                const std::string name =
                    osgDB::getSimpleFileName(texture->getImage()->getFileName());
                images[name] = texture->getImage();
                if (unit == 0)
                    surfaces[name].push_back(drawable.asGeometry());
            }
    }

    std::map<std::string, const osg::Image*> images;
    std::map<std::string, std::vector<const osg::Geometry*>> surfaces;
};

class OsgPhotoCityTest : public testing::Test
{
protected:
    static support::ProcessResult run(const std::vector<std::string>& words)
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_OSGPHOTOCITY};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        process.timeoutSeconds = 250.0;
        return process.run();
    }

    /// A photograph of its own, so that tests need none that is installed.
    OsgPhotoCityTest()
    {
        fs::create_directory(folder.file("photos"));
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(900, 700, 1, GL_RGB, GL_UNSIGNED_BYTE);
        for (int i = 0; i < 900 * 700 * 3; ++i)
            image->data()[i] = static_cast<unsigned char>(
                128 + 90 * std::sin(i / 3 % 900 * 0.05 + i % 3) * std::cos(i / 2700 * 0.03));
        EXPECT_TRUE(osgDB::writeImageFile(*image, folder.file("photos/waves.jpg")));
    }

    /// The model's path.
    std::string made(const std::string& name, std::vector<std::string> words) const
    {
        words.insert(words.end(), {"--photos", folder.file("photos")});
        words.push_back(folder.file(name));
        const support::ProcessResult result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return words.back();
    }

    std::vector<fs::path> pictures(const std::string& stem, const std::string& ending) const
    {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder.file(stem + "_photos")))
            if (entry.path().extension() == ending)
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        return files;
    }

    support::TemporaryFolder folder;
};

} // namespace

TEST_F(OsgPhotoCityTest, writesAsManyDifferentPhotographsWithAsManyBytesAsAskedFor)
{
    for (const auto& [textures, mebibytes] : {std::pair(1, 1), {40, 12}})
    {
        const std::string stem = "town" + std::to_string(textures);
        made(stem + ".osgb", {"--textures", std::to_string(textures), "--bytes",
                              std::to_string(mebibytes) + "MiB"});
        const auto files = pictures(stem, ".jpg");
        EXPECT_EQ(files.size(), std::size_t(textures));
        double bytes = 0.0;
        std::set<std::string> contents;
        for (const fs::path& file : files)
        {
            bytes += double(fs::file_size(file));
            contents.insert(contentOf(file));
        }
        EXPECT_EQ(contents.size(), files.size());
        EXPECT_NEAR(bytes / (mebibytes << 20), 1.0, 0.02);
    }
}

TEST_F(OsgPhotoCityTest, photographsDecodeAndHaveSidesOf512To8192OfAllKinds)
{
    made("town.osgb", {"--textures", "60", "--bytes", "20MiB"});
    int powers = 0, odd = 0, grey = 0;
    for (const fs::path& file : pictures("town", ".jpg"))
    {
        const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(file.string());
        ASSERT_TRUE(image) << file;
        for (const int side : {image->s(), image->t()})
        {
            EXPECT_GE(side, 512);
            EXPECT_LE(side, 8192);
        }
        const auto isPower = [](int side) { return (side & (side - 1)) == 0; };
        powers += isPower(image->s()) && isPower(image->t());
        odd += image->s() % 2 == 1 || image->t() % 2 == 1;
        grey += image->getPixelFormat() == GL_LUMINANCE;
    }
    EXPECT_GT(powers, 10);
    EXPECT_GT(odd, 10);
    EXPECT_GT(grey, 0);
    EXPECT_LT(grey, 20);
}

TEST_F(OsgPhotoCityTest, everyFormatNamesPicturesThatAreThere)
{
    for (const char* ending : {"osgb", "osgt", "ive", "obj", "iv"})
    {
        const std::string file =
            made("town." + std::string(ending), {"--textures", "30", "--bytes", "6MiB"});
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
        ASSERT_TRUE(node) << file;
        Surfaces found;
        node->accept(found);
        const auto files = pictures("town", ".jpg");
        ASSERT_EQ(files.size(), 30u);
        for (const fs::path& picture : files)
            EXPECT_EQ(found.surfaces.count(picture.filename().string()), 1u)
                << ending << ": " << picture;
        osg::ComputeBoundsVisitor bounds;
        node->accept(bounds);
        EXPECT_NEAR(bounds.getBoundingBox().zMin(), 0.0, 1e-3) << ending;
        EXPECT_GT(bounds.getBoundingBox().zMax(), 8.0) << ending;
        // The model alone, without pixels.
        EXPECT_LT(fs::file_size(file), 1u << 20) << ending;
    }
}

TEST_F(OsgPhotoCityTest, facadesAreUprightAndNotMirroredAndOnlyRepeatWherePicturesDo)
{
    const auto node =
        osgDB::readRefNodeFile(made("town.osgb", {"--textures", "80", "--bytes", "14MiB"}));
    ASSERT_TRUE(node);
    Surfaces found;
    node->accept(found);
    int repeated = 0, alpha = 0;
    for (const auto& [name, geometries] : found.surfaces)
        for (const osg::Geometry* geometry : geometries)
        {
            const auto& at = static_cast<const osg::Vec3Array&>(*geometry->getVertexArray());
            const auto& to = static_cast<const osg::Vec2Array&>(*geometry->getTexCoordArray(0));
            ASSERT_EQ(at.size(), 4u);
            EXPECT_EQ(to[0], osg::Vec2(0, 0));
            const auto& normal =
                static_cast<const osg::Vec3Array&>(*geometry->getNormalArray()).front();
            // s runs to the right and t upwards for who looks at the front.
            EXPECT_GT(((at[1] - at[0]) ^ (at[3] - at[0])) * normal, 0.0f) << name;
            EXPECT_GT(to[1].x(), 0.0f);
            EXPECT_GT(to[3].y(), 0.0f);
            if (name.rfind("facade", 0) == 0)
            {
                EXPECT_GT((at[3] - at[0]).z(), 3.0f);
            }
            const auto* texture = static_cast<const osg::Texture2D*>(
                geometry->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
            const bool wraps = texture->getWrap(osg::Texture::WRAP_S) == osg::Texture::REPEAT;
            if (to[2].x() > 1.0f || to[2].y() > 1.0f)
            {
                EXPECT_TRUE(wraps) << name;
                ++repeated;
            }
            alpha += found.images[name]->isImageTranslucent();
        }
    EXPECT_GT(repeated, 5);
    EXPECT_GT(alpha, 0);
    EXPECT_TRUE(found.images.lower_bound("normals") != found.images.end());
}

TEST_F(OsgPhotoCityTest, needsNoPhotographsToBeNamed)
{
    const std::string file = folder.file("town.osgb");
    const support::ProcessResult result = run({"--textures", "1", "--bytes", "300KiB", file});
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_TRUE(osgDB::readRefNodeFile(file));
}

TEST_F(OsgPhotoCityTest, aSeedGivesOneTownAndOneSetOfPhotographs)
{
    const auto filesOf = [&](const char* name, const char* seed)
    {
        made(std::string(name) + ".osgt", {"--textures", "12", "--bytes", "3MiB", "--seed", seed});
        std::vector<std::string> contents;
        for (const fs::path& file : pictures(name, ".jpg"))
            contents.push_back(contentOf(file));
        return contents;
    };
    const auto first = filesOf("a", "5");
    EXPECT_EQ(first, filesOf("b", "5"));
    EXPECT_NE(first, filesOf("c", "6"));
}

TEST_F(OsgPhotoCityTest, theFlightStartsLowOverAStreetAndJumps)
{
    made("town.osgb", {"--textures", "30", "--bytes", "6MiB", "--path", folder.file("town.path")});
    std::ifstream in(folder.file("town.path"));
    double time, x, y, z, turn[4], before = -1.0;
    int jumps = 0, points = 0;
    while (in >> time >> x >> y >> z >> turn[0] >> turn[1] >> turn[2] >> turn[3])
    {
        EXPECT_GT(time, before);
        if (points++ == 0)
        {
            EXPECT_NEAR(std::fmod(std::abs(x), 80.0), 40.0, 8.0);
            EXPECT_LT(z, 10.0);
        }
        else
            jumps += time - before < 0.01;
        before = time;
    }
    EXPECT_GT(points, 50);
    EXPECT_EQ(jumps, 6);
}

TEST_F(OsgPhotoCityTest, wrongSwitchesAndWhatCannotBeReachedAreNamed)
{
    const auto errorOf = [](const std::vector<std::string>& words)
    {
        const support::ProcessResult result = run(words);
        EXPECT_EQ(result.exitCode, 1);
        return result.errors;
    };
    fs::create_directory(folder.file("empty"));
    EXPECT_EQ(errorOf({}), "osgphotocity: FILE is required; see --help\n");
    EXPECT_EQ(
        errorOf({"--textures", "0", "x.osgb"}),
        "osgphotocity: --textures: needs a whole number from 1 to 50000, not '0'; see --help\n");
    EXPECT_EQ(errorOf({"--bytes", "much", "x.osgb"}),
              "osgphotocity: --bytes: needs a size such as 1.5GiB, 200MiB, 64KiB or 1000000, not "
              "'much'; see --help\n");
    EXPECT_EQ(errorOf({"a.osgb", "b.osgb"}),
              "osgphotocity: 'b.osgb' is one argument too many; see --help\n");
    EXPECT_EQ(errorOf({"/no/such/folder/x.osgb"}),
              "osgphotocity: cannot write '/no/such/folder/x.osgb': no such folder\n");
    EXPECT_NE(errorOf({folder.file("x.nothing")}).find("no plugin"), std::string::npos);
    EXPECT_NE(errorOf({"--photos", "/no/such", folder.file("x.osgb")}).find("'/no/such'"),
              std::string::npos);
    EXPECT_NE(
        errorOf({"--photos", folder.file("empty"), folder.file("x.osgb")}).find("no photograph"),
        std::string::npos);
    EXPECT_NE(errorOf({"--textures", "2", "--bytes", "2KiB", "--photos", folder.file("photos"),
                       folder.file("x.osgb")})
                  .find("change --textures"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(folder.file("x.osgb")));
    EXPECT_NE(run({"--help"}).output.find("--textures N"), std::string::npos);
}
