// SPDX-License-Identifier: MIT
#include "MaskCheck.h"

#include <osg/Group>

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
}

osg::ref_ptr<osg::Image> MaskCheck::render(osg::Node& scene, const support::CameraSpec& camera,
                                           int light, const Way& way, int width, int height)
{
    if (_kit->getNumChildren() != 1 || _kit->getChild(0) != &scene)
    {
        _kit->removeChildren(0, _kit->getNumChildren());
        _kit->addChild(&scene);
    }
    _kit->setShadows(way.shadows);
    _kit->setTechnique(way.technique);
    _kit->setLightShown(light);
    return _viewer.render(_kit, camera, width, height);
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
    std::vector<Sample> samples;
    for (int larger = 1; larger <= MaxEnlargement; ++larger)
    {
        result.width = larger * _width;
        result.height = larger * _height;
        samples = truth.render(*found, result.width, result.height);
        if (bandShare(samples, result.width, result.height) <= MaxBandShare)
            break;
    }
    for (const Way& way : ways)
    {
        const auto mask = render(scene, camera, light, way, result.width, result.height);
        if (!mask)
            return result;
        std::vector<unsigned char> wrong;
        const MaskDifference difference = compareMask(*mask, truth, *found, samples, &wrong);
        result.differences[way.getName()] = difference;
        if (std::getenv("OSGKITS_KEEP_IMAGES"))
            writePictures(*mask, samples, wrong, name + "." + way.getName());
        if (!isFailure || way.shadows == Shadows::MAP || difference.leaks == 0)
            continue;
        std::string where;
        for (std::size_t i = 0; i < difference.leakPixels.size() && i < 5; ++i)
            where += " (" + std::to_string(difference.leakPixels[i].first) + " " +
                     std::to_string(difference.leakPixels[i].second) + ")";
        ADD_FAILURE() << name << ", " << way.getName() << ": " << difference.leaks << " leaks of "
                      << difference.object << " pixels, at" << where << "; "
                      << writePictures(*mask, samples, wrong, name + "." + way.getName());
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
            sum.object += found->second.object;
            sum.wrongBand += found->second.wrongBand;
            sum.wrongGrazing += found->second.wrongGrazing;
            sum.withinQuantum += found->second.withinQuantum;
            sum.withinRounding += found->second.withinRounding;
            sum.leaks += found->second.leaks;
        }
        std::printf("\n");
    }
    for (const auto& [way, sum] : sums)
        std::printf(
            "%s: of %u pixels wrong in the band %u, at grazing light %u, within a quantum of "
            "depth %u, of the light %u, leaks %u\n",
            way.c_str(), sum.object, sum.wrongBand, sum.wrongGrazing, sum.withinQuantum,
            sum.withinRounding, sum.leaks);
}

bool isLongRun()
{
    return std::getenv("OSGKITS_LONG") != nullptr;
}

} // namespace truth
