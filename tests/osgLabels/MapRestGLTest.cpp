// SPDX-License-Identifier: MIT
// Map labels that come and go as a camera swings past buildings: how often, and what becomes of
// them when it comes to rest.
#include "MapPictures.h"

#include <cmath>
#include <cstdlib>

using namespace mapScene;

namespace
{

constexpr int Width = 128, Height = 96;
constexpr int Labels = 5;
const bool isLong = std::getenv("OSGKITS_LONG") != nullptr;

class MapRest : public MapTest, public testing::WithParamInterface<const char*>
{
protected:
    /// Labels in a row, behind posts that stand as far apart.
    static osg::ref_ptr<osgLabels::LabelScene> street(const std::string& settings)
    {
        std::vector<osg::ref_ptr<osg::Node>> nodes;
        std::vector<osgLabels::MapLabel> labels;
        for (int i = 0; i < Labels; ++i)
        {
            const float x = 0.45f * float(i) - 0.9f;
            nodes.push_back(box("post", {x, -1, 0}, {0.08f, 0.05f, 1.2f}, {0.4f, 0.5f, 0.9f, 1}));
            labels.push_back({{x, 0.1 * i, 0.35 * i - 0.7}, "text", double(i % 3), {}, {}});
        }
        nodes.push_back(new osgLabels::MapLabels(labels));
        return scene(nodes, "mapsize=10," + settings);
    }

    /// From side to side and back in 1.1 s, so that each label would change several times in it.
    static support::CameraSpec cameraAt(double time, double speed)
    {
        support::CameraSpec camera = labelScene::fromFront(double(Width) / Height);
        camera.view.preMultTranslate(osg::Vec3d(0.5 * std::sin(5.7 * speed * time), 0, 0));
        return camera;
    }

    static Picture draw(osgLabels::LabelScene& scene, double time,
                        const support::CameraSpec& camera)
    {
        labelScene::viewer().setSimulationTime(1.0 + time);
        return labelScene::render(scene, camera, Width, Height, 1);
    }

    /// Which labels are shown, each by the rows of the picture that are its own.
    static unsigned int shownIn(const osg::Image& picture)
    {
        unsigned int shown = 0;
        for (int i = 0; i < Labels; ++i)
        {
            const int row = int((0.5 + 0.5 * (0.35 * i - 0.7) / (1.0 + 0.025 * i)) * Height);
            for (int x = 0; x < picture.s(); ++x)
            {
                const osg::Vec4 color = picture.getColor(unsigned(x), unsigned(row));
                if (color.r() > 0.9f && color.g() < 0.1f && color.b() < 0.1f)
                    shown |= 1u << i;
            }
        }
        return shown;
    }
};

} // namespace

TEST_P(MapRest, nothingChangesWhereverTheCameraStops)
{
    unsigned int changes = 0;
    for (int stop = 1; stop <= (isLong ? 40 : 12); ++stop)
    {
        const auto top = street(GetParam());
        const support::CameraSpec last = cameraAt(0.1 * stop, 1.0);
        Picture before;
        for (int i = 0; i <= stop; ++i)
        {
            const Picture now = draw(*top, 0.1 * i, cameraAt(0.1 * i, 1.0));
            changes += before && shownIn(*now) != shownIn(*before);
            before = now;
        }
        // 5 s: more than anything is held back for.
        const int frames = isLong ? 300 : 50;
        for (int i = 1; i <= frames; ++i)
            ASSERT_TRUE(labelScene::areEqual(draw(*top, 0.1 * stop + 5.0 * i / frames, last),
                                             before, "map-stop"))
                << "stop " << stop << ", frame " << i;
    }
    EXPECT_GT(changes, 3u) << "the camera's way changes nothing";
}

TEST_P(MapRest, aLabelChangesOnceASecondHoweverFastTheCameraMoves)
{
    const auto top = street(GetParam());
    std::vector<double> last(Labels, -10.0);
    unsigned int before = 0, changes = 0;
    for (int i = 0; i < (isLong ? 600 : 200); ++i)
    {
        const double time = 0.05 * i;
        const unsigned int now = shownIn(*draw(*top, time, cameraAt(time, 2.0)));
        for (unsigned int label = 0; label < Labels && i > 0; ++label)
            if ((now ^ before) >> label & 1u)
            {
                EXPECT_GT(time - last[label], 0.9999) << "label " << label << " at " << time;
                last[label] = time;
                ++changes;
            }
        before = now;
    }
    EXPECT_GT(changes, 5u);
}

INSTANTIATE_TEST_SUITE_P(Tests, MapRest,
                         testing::Values("maptest=share", "maptest=anchor",
                                         "maptest=share,declutter=on",
                                         "maptest=anchor,declutter=on"));
