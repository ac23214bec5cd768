// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PhotoMask.h>

#include <osgPagedTexture/MaskMargin.h>
#include <osgPagedTexture/MaskPiece.h>
#include <osgPagedTexture/MaskTriangles.h>
#include <osgPagedTexture/Shaders.h>

#include <osg/Program>
#include <osg/Uniform>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

osg::ref_ptr<osg::StateSet> makeStateSet(bool conservative)
{
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("osgPagedTexture.photoMask");
    const auto add = [&](osg::Shader::Type type, const char* file, const char* builtIn)
    {
        program->addShader(osgDB::readRefShaderFileWithFallback(
            type, std::string("osgPagedTexture/") + file, builtIn));
    };
    add(osg::Shader::VERTEX, "photoMask.vert", shaders::photoMask_vert);
    if (conservative)
    {
        add(osg::Shader::GEOMETRY, "photoMaskTouched.geom", shaders::photoMaskTouched_geom);
        add(osg::Shader::FRAGMENT, "photoMaskTouched.frag", shaders::photoMaskTouched_frag);
    }
    else
    {
        add(osg::Shader::FRAGMENT, "photoMask.frag", shaders::photoMask_frag);
    }
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    stateSet->setAttributeAndModes(program);
    return stateSet;
}

std::size_t countUsed(const Pixels& mask)
{
    return std::size_t(std::count(mask.bytes.begin(), mask.bytes.end(), std::uint8_t(255)));
}

bool repeats(const Photo& photo, PhotoWrap PhotoSurface::*wrap)
{
    return std::any_of(photo.surfaces.begin(), photo.surfaces.end(),
                       [&](const PhotoSurface& each) { return each.*wrap == PhotoWrap::Repeat; });
}

} // namespace

struct MaskRenderer::State
{
    osg::ref_ptr<osg::GraphicsContext> context;
    osg::ref_ptr<osg::StateSet> covered = makeStateSet(false);
    osg::ref_ptr<osg::StateSet> touched = makeStateSet(true);
    int largestPiece = 0;

    const osg::StateSet& apply(bool conservative);
    void draw(const Photo& photo, const MaskSettings& settings, PhotoMask& mask);
};

MaskRenderer::MaskRenderer(osg::GraphicsContext& context) : _state(new State)
{
    _state->context = &context;
    if ((!context.isRealized() && !context.realize()) || !context.makeCurrent())
        throw MaskError("masks need an OpenGL context, and this one can't be made current");
    context.getState()->initializeExtensionProcs();
    const auto* gl = context.getState()->get<osg::GLExtensions>();
    if (gl->glVersion < 3.3f)
        throw MaskError("masks need OpenGL 3.3, this context has " + std::to_string(gl->glVersion));
    _state->largestPiece = MaskPiece::getLargestSide();
}

MaskRenderer::~MaskRenderer()
{
    if (_state->context->makeCurrent())
    {
        _state->covered->releaseGLObjects(_state->context->getState());
        _state->touched->releaseGLObjects(_state->context->getState());
    }
}

/// Binds the program and returns what it was bound with.
const osg::StateSet& MaskRenderer::State::apply(bool conservative)
{
    osg::State& state = *context->getState();
    const osg::StateSet& stateSet = conservative ? *touched : *covered;
    state.apply(&stateSet);
    const auto* program =
        static_cast<const osg::Program*>(stateSet.getAttribute(osg::StateAttribute::PROGRAM));
    if (!program->getPCP(state)->isLinked())
        throw MaskError("the driver does not take the shaders of masks; update it");
    return stateSet;
}

void MaskRenderer::State::draw(const Photo& photo, const MaskSettings& settings, PhotoMask& mask)
{
    const int side =
        settings.largestPiece > 0 ? std::min(settings.largestPiece, largestPiece) : largestPiece;
    apply(settings.conservative);
    const auto* program = static_cast<const osg::Program*>(
        (settings.conservative ? touched : covered)->getAttribute(osg::StateAttribute::PROGRAM));
    const GLint size =
        program->getPCP(*context->getState())->getUniformLocation("osgPagedTexture_pieceSize");
    MaskPieces pieces(*context->getState()->get<osg::GLExtensions>(), photo.width, photo.height,
                      side, size);
    // Half a pixel around a triangle belongs to it where what it touches counts.
    const double reach = settings.conservative ? 1.0 : 0.0;
    MaskTriangles triangles(photo.width, photo.height,
                            [&](const PixelTriangle& triangle) { pieces.add(triangle, reach); });
    for (const PhotoSurface& surface : photo.surfaces)
    {
        for (std::size_t i = 0; 3 * i < surface.coordinates.size(); ++i)
            triangles.add(surface, i);
        mask.skipped += surface.skipped;
    }
    mask.whole = triangles.getWholeCount();
    pieces.read(mask.pixels);
}

PhotoMask MaskRenderer::render(const Photo& photo, const MaskSettings& settings)
{
    if (!_state->context->makeCurrent())
        throw MaskError("the OpenGL context of masks can't be made current");
    PhotoMask mask;
    mask.pixels = Pixels(photo.width, photo.height, 1);
    _state->draw(photo, settings, mask);
    growMask(mask.pixels, settings.margin, repeats(photo, &PhotoSurface::wrapS),
             repeats(photo, &PhotoSurface::wrapT));
    if (!mask.pixels.empty())
        mask.usedShare = double(countUsed(mask.pixels)) / double(mask.pixels.bytes.size());
    return mask;
}

namespace
{

bool hasInterface(osg::GraphicsContext::WindowingSystemInterfaces& interfaces,
                  const std::string& name)
{
    for (const auto& each : interfaces.getInterfaces())
        if (each->getName() == name)
            return true;
    return false;
}

} // namespace

osg::ref_ptr<osg::GraphicsContext> makeOffscreenContext()
{
    // Whatever else the program has: a window system may have no display.
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = traits->height = 16;
    traits->pbuffer = true;
    traits->windowingSystemPreference = "EGL";
    if (!hasInterface(*osg::GraphicsContext::getWindowingSystemInterfaces(),
                      traits->windowingSystemPreference))
    {
        osgDB::Registry* registry = osgDB::Registry::instance();
        const std::string plugin = registry->createLibraryNameForExtension("egl");
        if (registry->loadLibrary(plugin) == osgDB::Registry::NOT_LOADED)
            throw MaskError("masks need OpenGL, and the plugin " + plugin +
                            " can't be loaded; set OSG_LIBRARY_PATH to the folder that holds it");
    }
    const osg::ref_ptr<osg::GraphicsContext> context =
        osg::GraphicsContext::createGraphicsContext(traits);
    if (!context || !context->valid())
        throw MaskError("masks need OpenGL, and no context can be made on this machine");
    return context;
}

} // namespace osgPagedTexture
