// SPDX-License-Identifier: MIT
#include <precision/Sweep.h>

#include <CityPictures.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>
#include <stdexcept>

namespace
{

using namespace cityPictures;
using mapTruth::Effect;
using precision::Outcome;

const std::vector<double> Seconds = {2.0, 10.0, 18.0, 26.0, 34.0}; ///< Of the recorded path.
const std::vector<double> Offsets = {0.0, 3.0, 10.0, 30.0, 100.0};

/// Of all threads of the program: a software renderer works in several, and others may be busy.
double getCpuSeconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A look at the town, and what should be seen of its labels.
struct Place
{
    support::CameraSpec camera;
    std::vector<InView> labels;
    std::vector<PlatePixel> pixels;
    std::vector<bool> isHidden; ///< By pixel.
    Picture bare;
};

/// Plates as quads at the depths of their anchors, `offset` nearer to the eye, for a depth test:
/// what labels are without identifiers and back faces.
osg::ref_ptr<osg::Node> makeQuads(const Place& place, double offset)
{
    const osg::Matrixd toEye = osg::Matrixd::inverse(place.camera.projection);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const InView& label : place.labels)
    {
        const osgLabels::Rectangle& space = label.space;
        for (const auto& [x, y] : {std::pair(space.low.x, space.low.y),
                                   {space.high.x, space.low.y},
                                   {space.high.x, space.high.y},
                                   {space.low.x, space.high.y}})
        {
            osg::Vec3d corner =
                osg::Vec3d(2.0 * x / Width - 1.0, 2.0 * y / Height - 1.0, 0.0) * toEye;
            corner *= std::max(label.depth - offset, 1.001) / -corner.z();
            vertices->push_back(corner);
        }
    }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::Vec4 red(1.0f, 0.0f, 0.0f, 1.0f);
    geometry->setVertexArray(vertices);
    geometry->setColorArray(new osg::Vec4Array(1, &red), osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, static_cast<int>(vertices->size())));
    geometry->setCullingActive(false);
    const osg::ref_ptr<osg::MatrixTransform> eye = new osg::MatrixTransform;
    eye->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    eye->setCullingActive(false);
    eye->addChild(geometry);
    osg::StateSet* const state = eye->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    state->setRenderBinDetails(1, "RenderBin");
    return eye;
}

class Workshop
{
public:
    Workshop()
    {
        if (!viewer().isValid())
            throw std::runtime_error(viewer().getError());
        for (const double seconds : Seconds)
            _places.push_back(makePlace(seconds));
    }

    /// All places; the error in percent of the labels' pixels.
    Outcome draw(const std::string& method, double offset)
    {
        Outcome outcome;
        outcome.seconds = 0.0;
        std::size_t wrong = 0, all = 0;
        for (std::size_t i = 0; i < _places.size(); ++i)
        {
            const Place& place = _places[i];
            osg::ref_ptr<osg::Node>& node = _nodes[{method, {offset, i}}];
            if (!node)
                node = makeNode(method, place, offset);
            const double start = getCpuSeconds();
            const Picture picture = render(*node, place.camera);
            outcome.seconds += (getCpuSeconds() - start) / double(_places.size());
            if (!picture)
                throw std::runtime_error("no picture");
            for (std::size_t k = 0; k < place.pixels.size(); ++k)
                wrong += (effectIn(*picture, *place.bare, place.pixels[k]) == Effect::Hide) !=
                         place.isHidden[k];
            all += place.pixels.size();
        }
        outcome.number = 100.0 * double(wrong) / double(all);
        return outcome;
    }

private:
    Place makePlace(double seconds)
    {
        Place place;
        place.camera = cameraAt(seconds);
        place.labels = chooseSpread(_town.labels, place.camera, static_cast<unsigned int>(seconds));
        place.pixels = platePixels(place.labels, place.camera);
        place.bare = render(*makeScene(_town.scene, {}), place.camera);
        const mapTruth::MapTruth truth(*_town.scene, place.camera, Width, Height);
        for (const PlatePixel& pixel : place.pixels)
        {
            const InView& label = place.labels[pixel.label];
            place.isHidden.push_back(truth.at({label.depth, label.label.feature, false},
                                              pixel.x + 0.5, pixel.y + 0.5) == Effect::Hide);
        }
        return place;
    }

    osg::ref_ptr<osg::Node> makeNode(const std::string& method, const Place& place,
                                     double offset) const
    {
        if (method == "depth test")
        {
            const osg::ref_ptr<osg::Group> group = new osg::Group;
            group->addChild(_town.scene);
            group->addChild(makeQuads(place, offset));
            return group;
        }
        return makeScene(_town.scene, place.labels,
                         "declutter=off,mapoffset=" + std::to_string(offset) +
                             ",maptest=" + (method == "back faces" ? "pixel" : "anchor"));
    }

    const City _town = makeTown();
    std::vector<Place> _places;
    std::map<std::pair<std::string, std::pair<double, std::size_t>>, osg::ref_ptr<osg::Node>>
        _nodes;
};

precision::Sweep makeSweep()
{
    const auto shop = std::make_shared<Workshop>();
    precision::Sweep sweep;
    sweep.name = "map-labels";
    sweep.title = "Labels of a town of 500 buildings from five places of a recorded path, 640x480, "
                  "CPU time of a frame";
    sweep.errorName =
        "wrongly shown and wrongly hidden pixels in percent of the labels', against ray casting";
    sweep.renderer = getRenderer();
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    for (const char* name : {"back faces", "depth test", "anchor"})
        sweep.methods.push_back({name, "m towards the eye", Offsets,
                                 [shop, name](double offset) { return shop->draw(name, offset); }});
    return sweep;
}

const precision::Registration registration("map-labels", makeSweep);

} // namespace
