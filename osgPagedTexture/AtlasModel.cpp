// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasModel.h>

#include <osgPagedTexture/AtlasGeometry.h>
#include <osgPagedTexture/TextureState.h>

#include <osg/CopyOp>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <osg/ValueObject>

#include <map>
#include <set>

namespace osgPagedTexture
{

namespace
{

using Attribute = osg::StateAttribute;

/// Visits each drawable with the state of unit 0 on the path to it.
class UnitVisitor : public TextureStateVisitor
{
protected:
    virtual void visitUnit(osg::Drawable& drawable, const TextureUnit& unit) = 0;

private:
    void visit(osg::Drawable& drawable, const TextureState& state) override
    {
        const TextureUnit unit = state.get(0);
        if (unit.texture && !unit.isOff)
            visitUnit(drawable, unit);
    }
};

/// Whether a drawable shows different textures on different paths.
class ConflictFinder : public UnitVisitor
{
public:
    bool found = false;

protected:
    void visitUnit(osg::Drawable& drawable, const TextureUnit& unit) override
    {
        const auto [place, isNew] = _seen.insert({&drawable, unit});
        found = found || (!isNew && place->second != unit);
    }

private:
    std::map<const osg::Drawable*, TextureUnit> _seen;
};

class AtlasVisitor : public UnitVisitor
{
public:
    AtlasVisitor(const ModelPhotos& model, const AtlasLayout& layout, const std::string& folder,
                 const AtlasModelSettings& settings)
        : _model(model), _layout(layout), _places(layout, folder), _settings(settings),
          _texture(makeTexture())
    {
    }

    AtlasModelReport report;
    std::set<const osg::Texture*> moved, kept;

protected:
    void visitUnit(osg::Drawable& drawable, const TextureUnit& unit) override
    {
        if (!_seen.insert(&drawable).second)
            return;
        const std::string reason = move(drawable, unit);
        if (reason.empty())
        {
            moved.insert(unit.texture.get());
            ++report.drawables;
            return;
        }
        kept.insert(unit.texture.get());
        const osg::Image* image = unit.texture->getImage(0);
        const std::string name = image ? image->getFileName() : std::string();
        if (_seenLeft.insert({name, reason}).second)
            report.left.push_back({name, reason});
    }

private:
    osg::ref_ptr<osg::Texture2D> makeTexture() const
    {
        osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(_settings.overview.get());
        texture->setName("osgPagedTexture.atlas");
        texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
        texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
        texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
        texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
        texture->setResizeNonPowerOfTwoHint(false);
        texture->setUserValue("osgPagedTexture.store", _settings.store);
        return texture;
    }

    std::string move(osg::Drawable& drawable, const TextureUnit& unit)
    {
        osg::Geometry* geometry = drawable.asGeometry();
        if (!geometry)
            return "its drawable is no geometry";
        if (!dynamic_cast<const osg::Texture2D*>(unit.texture.get()))
            return "it is not a 2D texture";
        if (unit.isGenerated)
            return "its coordinates are generated";
        GeometryPhoto photo;
        const std::string file = photoFileOf(*unit.texture, _model.images.get());
        if (file.empty())
            return "it is inside of the model and no file";
        photo.pieces = _places.find(file);
        if (!photo.pieces)
            return "it is not in the layout";
        photo.wrapS = wrapOf(*unit.texture, osg::Texture::WRAP_S);
        photo.wrapT = wrapOf(*unit.texture, osg::Texture::WRAP_T);
        if (unit.matrix)
            photo.toTexture = unit.matrix->getMatrix();
        GeometryCounts counts;
        const std::string reason =
            moveGeometry(*geometry, photo, _places, _layout, _settings.mostRepeats, counts);
        if (!reason.empty())
            return reason;
        drawable.setStateSet(stateSetFor(drawable.getStateSet(), unit).get());
        report.triangles += counts.triangles;
        report.split += counts.split;
        report.written += counts.written;
        report.notFinite += counts.notFinite;
        report.largestRounding = std::max(report.largestRounding, counts.largestRounding);
        return {};
    }

    /// One for all drawables that shared one. What a StateSet above has is beaten by PROTECTED,
    /// whatever its flags are.
    osg::ref_ptr<osg::StateSet> stateSetFor(const osg::StateSet* old, const TextureUnit& unit)
    {
        osg::ref_ptr<osg::StateSet>& made = _stateSets[{old, unit.matrix.valid()}];
        if (made)
            return made;
        made = old ? new osg::StateSet(*old) : new osg::StateSet;
        made->setTextureAttributeAndModes(0, _texture, Attribute::ON | Attribute::PROTECTED);
        made->removeTextureAttribute(0, Attribute::TEXMAT);
        if (unit.matrix)
            made->setTextureAttribute(0, new osg::TexMat, Attribute::ON | Attribute::PROTECTED);
        return made;
    }

    const ModelPhotos& _model;
    const AtlasLayout& _layout;
    const AtlasPlaces _places;
    const AtlasModelSettings& _settings;
    const osg::ref_ptr<osg::Texture2D> _texture;
    std::set<const osg::Drawable*> _seen;
    std::set<std::pair<std::string, std::string>> _seenLeft;
    std::map<std::pair<const osg::StateSet*, bool>, osg::ref_ptr<osg::StateSet>> _stateSets;
};

/// Takes textures that nothing shows any more out of the StateSets above the drawables.
class TextureRemover : public osg::NodeVisitor
{
public:
    explicit TextureRemover(std::set<const osg::Texture*> unused)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _unused(std::move(unused))
    {
    }

    void apply(osg::Node& node) override
    {
        osg::StateSet* stateSet = node.getStateSet();
        const osg::StateAttribute* attribute =
            stateSet ? stateSet->getTextureAttribute(0, Attribute::TEXTURE) : nullptr;
        if (attribute && _unused.count(attribute->asTexture()) > 0)
            stateSet->removeTextureAttribute(0, Attribute::TEXTURE);
        traverse(node);
    }
    void apply(osg::Drawable& drawable) override { apply(static_cast<osg::Node&>(drawable)); }

private:
    const std::set<const osg::Texture*> _unused;
};

} // namespace

AtlasModelReport moveToAtlas(ModelPhotos& model, const AtlasLayout& layout,
                             const std::string& folder, const AtlasModelSettings& settings)
{
    ConflictFinder conflicts;
    model.model->accept(conflicts);
    if (conflicts.found)
    {
        // Without a memory of what it has copied, a copy is a tree.
        model.model = static_cast<osg::Node*>(
            model.model->clone(osg::CopyOp::DEEP_COPY_NODES | osg::CopyOp::DEEP_COPY_DRAWABLES |
                               osg::CopyOp::DEEP_COPY_ARRAYS | osg::CopyOp::DEEP_COPY_PRIMITIVES |
                               osg::CopyOp::DEEP_COPY_STATESETS));
    }
    AtlasVisitor visitor(model, layout, folder, settings);
    model.model->accept(visitor);
    std::set<const osg::Texture*> unused;
    for (const osg::Texture* texture : visitor.moved)
        if (visitor.kept.count(texture) == 0)
            unused.insert(texture);
    TextureRemover remover(unused);
    model.model->accept(remover);
    return visitor.report;
}

} // namespace osgPagedTexture
