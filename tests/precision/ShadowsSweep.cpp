// SPDX-License-Identifier: MIT
#include <precision/ShadowScenes.h>
#include <precision/Sweep.h>

#include <osgShadowVolume/ShadowTruth.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <osg/LightModel>
#include <osg/Material>
#include <osg/Timer>
#include <osgDB/Registry>
#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowedScene>
#include <osgShadow/ViewDependentShadowMap>

#include <map>
#include <memory>
#include <stdexcept>

namespace
{

using osgShadowVolume::Shadows;
using osgShadowVolume::Technique;
using precision::Outcome;

constexpr int Width = 640, Height = 480;
/// |N.L| below which a surface is as dark in light as in shadow.
constexpr double Grazing = 0.02;

/// Shaders on disk, before the built-in ones, while it lives.
class OtherShaders
{
public:
    explicit OtherShaders(const std::string& folder)
        : _paths(osgDB::Registry::instance()->getDataFilePathList())
    {
        osgDB::Registry::instance()->getDataFilePathList().push_front(folder);
    }
    ~OtherShaders() { osgDB::Registry::instance()->getDataFilePathList() = _paths; }
    OtherShaders(const OtherShaders&) = delete;
    OtherShaders& operator=(const OtherShaders&) = delete;

private:
    const osgDB::FilePathList _paths;
};

/// One scene with its truth, and all ways to draw it.
class Workshop
{
public:
    explicit Workshop(precision::ShadowScene (*makeScene)(double aspect))
        : _scene(makeScene(double(Width) / Height))
    {
        support::HeadlessSettings settings;
        settings.width = Width;
        settings.height = Height;
        _viewer = std::make_unique<support::HeadlessViewer>(settings);
        if (!_viewer->isValid())
            throw std::runtime_error(_viewer->getError());
        _viewer->getViewer().setLightingMode(osg::View::NO_LIGHT);
        const truth::ShadowTruth truth(*_scene.root, _scene.camera);
        _truth = truth.render(*truth.findLight(0), Width, Height);
    }

    /// The picture is what is timed, the mask what is compared: it is drawn once.
    Outcome drawKit(const std::string& name, double value,
                    const std::function<void(osgShadowVolume::ShadowedScene&)>& set,
                    const std::string& shaders = {})
    {
        osg::ref_ptr<osg::Group>& scene = _scenes[{name, value}];
        std::unique_ptr<OtherShaders> other;
        if (!scene)
        {
            if (!shaders.empty())
                other = std::make_unique<OtherShaders>(shaders);
            osg::ref_ptr<osgShadowVolume::ShadowedScene> kit = new osgShadowVolume::ShadowedScene;
            kit->setLightScope(osgShadowVolume::LitScene::LightScope::ALL);
            kit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
            kit->setMapMegabytes(1024);
            set(*kit);
            kit->addChild(_scene.root);
            scene = kit;
            kit->setShow(osgShadowVolume::Show::MASK);
            _errors[{name, value}] = errorOf(*kit);
            kit->setShow(osgShadowVolume::Show::PICTURE);
        }
        return time(*scene, _errors[{name, value}]);
    }

    /// osgShadow's techniques multiply white surfaces without lighting: the picture is the mask.
    Outcome drawStock(const std::string& name, double value,
                      const std::function<void(osgShadow::ShadowedScene&)>& set)
    {
        osg::ref_ptr<osg::Group>& scene = _scenes[{name, value}];
        if (!scene)
        {
            osg::ref_ptr<osgShadow::ShadowedScene> stock = new osgShadow::ShadowedScene;
            set(*stock);
            stock->addChild(_scene.root);
            osg::StateSet* const state = stock->getOrCreateStateSet();
            state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
            state->setMode(GL_LIGHT0, osg::StateAttribute::ON);
            // What is left in shadow.
            osg::ref_ptr<osg::Material> material = new osg::Material;
            material->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
            state->setAttribute(material);
            scene = stock;
            draw(*scene);
            _errors[{name, value}] = errorOf(*scene);
        }
        return time(*scene, _errors[{name, value}]);
    }

    osg::Light* getLight() { return _scene.light; }

private:
    using Key = std::pair<std::string, double>;

    osg::ref_ptr<osg::Image> draw(osg::Node& scene)
    {
        osg::ref_ptr<osg::Image> image = _viewer->render(&scene, _scene.camera, Width, Height);
        if (!image)
            throw std::runtime_error("nothing was drawn");
        return image;
    }

    Outcome time(osg::Node& scene, double error)
    {
        draw(scene);
        const osg::Timer_t start = osg::Timer::instance()->tick();
        draw(scene);
        Outcome outcome;
        outcome.seconds = osg::Timer::instance()->delta_s(start, osg::Timer::instance()->tick());
        outcome.number = error;
        return outcome;
    }

    /// The share of the pixels that show a surface within the light's cone and are lit wrongly.
    /// Grazing light is left out; where only one of both shows a surface, the rasterizer decides.
    double errorOf(osg::Node& scene)
    {
        const osg::ref_ptr<osg::Image> mask = draw(scene);
        std::size_t all = 0, wrong = 0;
        for (int y = 0; y < Height; ++y)
            for (int x = 0; x < Width; ++x)
            {
                const truth::Sample& sample = _truth[std::size_t(y) * Width + std::size_t(x)];
                const truth::Seen seen = sample.seen;
                const unsigned char* const pixel = mask->data(x, y);
                const bool isBackground = pixel[0] != pixel[2];
                if (isBackground || sample.grazing < Grazing ||
                    (seen != truth::Seen::LIT && seen != truth::Seen::SHADOWED))
                    continue;
                ++all;
                wrong += (pixel[0] >= 128) != (seen == truth::Seen::LIT);
            }
        if (all == 0)
            throw std::runtime_error("no pixel shows a surface");
        return double(wrong) / double(all);
    }

    const precision::ShadowScene _scene;
    std::unique_ptr<support::HeadlessViewer> _viewer;
    std::vector<truth::Sample> _truth;
    std::map<Key, osg::ref_ptr<osg::Group>> _scenes;
    std::map<Key, double> _errors;
};

using Shop = std::shared_ptr<Workshop>;

precision::Method makeVolumes(const Shop& shop, const std::string& name, Technique technique,
                              const std::string& shaders = {})
{
    return {name,
            "technique",
            {1},
            [=](double value)
            {
                return shop->drawKit(
                    name, value, [=](auto& kit) { kit.setTechnique(technique); }, shaders);
            }};
}

precision::Method makeMaps(const Shop& shop, const std::string& name, unsigned int samples)
{
    return {name,
            "texels a side",
            {256, 512, 1024, 2048, 4096, 8192},
            [=](double value)
            {
                return shop->drawKit(name, value,
                                     [=](auto& kit)
                                     {
                                         kit.setShadows(Shadows::MAP);
                                         kit.setMapSize(unsigned(value));
                                         kit.setMapSamples(samples);
                                     });
            }};
}

/// `set` is given the texels a side.
precision::Method
makeStockMaps(const Shop& shop, const std::string& name,
              const std::function<void(osgShadow::ShadowedScene&, const osg::Vec2s&)>& set)
{
    return {name,
            "texels a side",
            {256, 1024, 4096},
            [=](double value)
            {
                const osg::Vec2s size{short(value), short(value)};
                return shop->drawStock(name, value, [&](auto& scene) { set(scene, size); });
            }};
}

precision::Method makeStockMap(const Shop& shop)
{
    return makeStockMaps(shop, "osgShadow::ShadowMap",
                         [=](auto& scene, const osg::Vec2s& size)
                         {
                             auto* const map = new osgShadow::ShadowMap;
                             map->setTextureSize(size);
                             map->setAmbientBias(osg::Vec2(0.0f, 1.0f));
                             map->setLight(shop->getLight());
                             scene.setShadowTechnique(map);
                         });
}

precision::Method makeStockViewDependentMap(const Shop& shop)
{
    return makeStockMaps(shop, "osgShadow::ViewDependentShadowMap",
                         [](auto& scene, const osg::Vec2s& size)
                         {
                             scene.getShadowSettings()->setTextureSize(size);
                             scene.setShadowTechnique(new osgShadow::ViewDependentShadowMap);
                         });
}

precision::Sweep makeShadowsSweep(const std::string& name, const std::string& title,
                                  precision::ShadowScene (*makeScene)(double aspect))
{
    const auto shop = std::make_shared<Workshop>(makeScene);
    precision::Sweep sweep;
    sweep.name = name;
    sweep.title = title;
    sweep.errorName = "share of wrong pixels against Embree";
    sweep.renderer = "llvmpipe";
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    const std::string judges = OSGKITS_JUDGES;
    sweep.methods = {
        makeVolumes(shop, "volumes tess", Technique::TESS),
        makeVolumes(shop, "volumes geometry", Technique::GEOMETRY),
        makeVolumes(shop, "volumes cpu", Technique::CPU),
        makeVolumes(shop, "edges in their own order", Technique::GEOMETRY, judges + "/edge-order"),
        makeVolumes(shop, "triangles discarded", Technique::GEOMETRY, judges + "/discarding"),
        makeMaps(shop, "maps", 1),
        makeMaps(shop, "maps 3x3 samples", 3),
        makeStockMap(shop),
        makeStockViewDependentMap(shop)};
    return sweep;
}

const precision::Registration
    model("shadows",
          []
          {
              return makeShadowsSweep("shadows", "Engine on a ground under a spot light, 640x480",
                                      precision::makeModelShadowScene);
          });
const precision::Registration wall("shadows-wall",
                                   []
                                   {
                                       return makeShadowsSweep(
                                           "shadows-wall", "Lamp in the plane of a wall, 640x480",
                                           precision::makeWallShadowScene);
                                   });

} // namespace
