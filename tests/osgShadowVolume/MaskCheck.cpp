// SPDX-License-Identifier: MIT
#include "MaskCheck.h"

#include <osg/Group>
#include <osg/NodeVisitor>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Shadows;
using osgShadowVolume::Technique;

namespace truth
{

namespace
{

constexpr int MaxEnlargement = 4;
constexpr double MaxBandShare = 0.25;

/// Takes from all lights with a number what shadows take away.
class LightSwitch : public osg::NodeVisitor
{
public:
    explicit LightSwitch(int number) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _number(number) {}

    void apply(osg::LightSource& source) override
    {
        osg::Light* const light = source.getLight();
        if (light && light->getLightNum() == _number)
        {
            _known.push_back({light, light->getDiffuse(), light->getSpecular()});
            light->setDiffuse({0.0f, 0.0f, 0.0f, 1.0f});
            light->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
        }
        traverse(source);
    }

    void restore()
    {
        // Backwards, for lights that are met twice.
        for (; !_known.empty(); _known.pop_back())
        {
            _known.back().light->setDiffuse(_known.back().diffuse);
            _known.back().light->setSpecular(_known.back().specular);
        }
    }

private:
    struct Known
    {
        osg::ref_ptr<osg::Light> light;
        osg::Vec4 diffuse, specular;
    };

    int _number;
    std::vector<Known> _known;
};

} // namespace

std::string Way::getName() const
{
    if (shadows == Shadows::MAP)
        return "map";
    switch (technique)
    {
    case Technique::AUTO:
        return "auto";
    case Technique::TESS:
        return "tess";
    case Technique::GEOMETRY:
        return "geometry";
    case Technique::CPU:
        return "cpu";
    }
    return {};
}

const std::vector<Way>& volumeWays()
{
    static const std::vector<Way> ways = {{Shadows::VOLUMES, Technique::TESS},
                                          {Shadows::VOLUMES, Technique::GEOMETRY},
                                          {Shadows::VOLUMES, Technique::CPU}};
    return ways;
}

Way mapWay()
{
    return {Shadows::MAP, Technique::AUTO};
}

unsigned int MaskResult::getLeaks() const
{
    unsigned int leaks = 0;
    for (const auto& [name, difference] : differences)
        leaks += name == "map" ? 0 : difference.leaks;
    return leaks;
}

MaskCheck::MaskCheck(int width, int height)
    : _width(width), _height(height), _viewer({width * MaxEnlargement, height * MaxEnlargement}),
      _kit(new ShadowedScene)
{
    _viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    _kit->setLightScope(ShadowedScene::LightScope::ALL);
    _kit->setLightTolerance(0.0);
    _kit->setShow(osgShadowVolume::Show::MASK);
    _kit->setKeys(false);
    _kit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
}

void MaskCheck::setUp(osg::Node& scene, int light, const Way& way)
{
    if (_kit->getNumChildren() != 1 || _kit->getChild(0) != &scene)
    {
        _kit->removeChildren(0, _kit->getNumChildren());
        _kit->addChild(&scene);
    }
    _kit->setShadows(way.shadows);
    _kit->setTechnique(way.technique);
    _kit->setLightShown(light);
}

osg::ref_ptr<osg::Image> MaskCheck::render(osg::Node& scene, const support::CameraSpec& camera,
                                           int light, const Way& way, int width, int height)
{
    setUp(scene, light, way);
    return _viewer.render(_kit, camera, width, height);
}

std::vector<float> MaskCheck::renderLight(osg::Node& scene, const support::CameraSpec& camera,
                                          int light, int width, int height)
{
    setUp(scene, light, {Shadows::OFF, Technique::AUTO});
    _kit->setShow(osgShadowVolume::Show::PICTURE);
    LightSwitch lights(light);
    const osg::ref_ptr<osg::Image> with = _viewer.renderFloat(_kit, camera, width, height);
    scene.accept(lights);
    const osg::ref_ptr<osg::Image> without = _viewer.renderFloat(_kit, camera, width, height);
    lights.restore();
    _kit->setShow(osgShadowVolume::Show::MASK);
    std::vector<float> colors(static_cast<std::size_t>(width) * height, 1.0f);
    for (int i = 0; with && without && i < width * height; ++i)
    {
        const osg::Vec4 added =
            with->getColor(i % width, i / width) - without->getColor(i % width, i / width);
        colors[i] = std::max({std::abs(added.r()), std::abs(added.g()), std::abs(added.b())});
    }
    return colors;
}

TruthPicture MaskCheck::renderTruth(const ShadowTruth& truth, const Light& light) const
{
    for (int larger = 1;; ++larger)
    {
        TruthPicture picture(truth, light, larger * _width, larger * _height);
        if (larger == MaxEnlargement || picture.getBandShare() <= MaxBandShare)
            return picture;
    }
}

MaskResult MaskCheck::compare(osg::Node& scene, const support::CameraSpec& camera, int light,
                              const std::string& name, const std::vector<Way>& ways, bool isFailure)
{
    MaskResult result;
    const ShadowTruth truth(scene, camera);
    const Light* const found = truth.findLight(light);
    if (!found)
    {
        ADD_FAILURE() << name << ": the scene has no light " << light;
        return result;
    }
    const TruthPicture picture = renderTruth(truth, *found);
    const int width = result.width = picture.width, height = result.height = picture.height;
    // Drawn where a pixel asks for it.
    std::vector<float> colors;
    const LightColor color = [&](int x, int y)
    {
        if (colors.empty())
            colors = renderLight(scene, camera, light, width, height);
        return colors[y * width + x];
    };
    for (const Way& way : ways)
    {
        const auto mask = render(scene, camera, light, way, width, height);
        if (!mask)
            return result;
        std::vector<unsigned char> wrong;
        const MaskDifference difference = compareMask(*mask, truth, *found, picture, color, &wrong);
        result.differences[way.getName()] = difference;
        if (std::getenv("OSGKITS_KEEP_IMAGES"))
            writePictures(*mask, picture.samples, wrong, name + "." + way.getName());
        if (!isFailure || way.shadows == Shadows::MAP || difference.leaks == 0)
            continue;
        std::string where;
        for (std::size_t i = 0; i < difference.leakPixels.size() && i < 5; ++i)
            where += " (" + std::to_string(difference.leakPixels[i].first) + " " +
                     std::to_string(difference.leakPixels[i].second) + ")";
        ADD_FAILURE() << name << ", " << way.getName() << ": " << difference.leaks << " leaks of "
                      << difference.object << " pixels, at" << where << "; "
                      << writePictures(*mask, picture.samples, wrong, name + "." + way.getName());
    }
    return result;
}

osg::ref_ptr<osg::LightSource> makeSource(int number, const osg::Vec4& position,
                                          const osg::Vec3& direction, float cutoffDegrees)
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    osg::ref_ptr<osg::Light> light = new osg::Light(number);
    light->setPosition(position);
    light->setDirection(direction);
    light->setSpotCutoff(cutoffDegrees);
    source->setLight(light);
    return source;
}

void MaskTable::add(const std::string& name, const MaskResult& result)
{
    _rows.emplace_back(name, result);
}

void MaskTable::print() const
{
    std::printf("%-44s %9s %6s", "wrong pixels, of them leaks", "size", "band");
    std::map<std::string, MaskDifference> sums;
    for (const auto& [name, result] : _rows)
        for (const auto& [way, difference] : result.differences)
            sums[way];
    for (const auto& [way, sum] : sums)
        std::printf(" %18s", way.c_str());
    std::printf("\n");
    const auto printOne = [](const MaskDifference& difference)
    { std::printf(" %9.4f%% %7u", 100.0 * difference.getErrorShare(), difference.leaks); };
    for (const auto& [name, result] : _rows)
    {
        const double band =
            result.differences.empty() ? 0.0 : result.differences.begin()->second.getBandShare();
        std::printf("%-44s %4dx%-4d %5.1f%%", name.c_str(), result.width, result.height,
                    100.0 * band);
        for (auto& [way, sum] : sums)
        {
            const auto found = result.differences.find(way);
            if (found == result.differences.end())
            {
                std::printf(" %18s", "");
                continue;
            }
            printOne(found->second);
            sum.add(found->second);
        }
        std::printf("\n");
    }
    for (const auto& [way, sum] : sums)
        std::printf("%s: %s\n", way.c_str(), sum.describe().c_str());
}

bool isLongRun()
{
    return std::getenv("OSGKITS_LONG") != nullptr;
}

} // namespace truth
