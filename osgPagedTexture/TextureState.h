// SPDX-License-Identifier: MIT
#pragma once

#include <osg/NodeVisitor>
#include <osg/StateSet>
#include <osg/TexMat>
#include <osg/Texture>

#include <vector>

namespace osgPagedTexture
{

/// What a drawable has on one texture unit, from all StateSets on a path to it.
struct TextureUnit
{
    osg::ref_ptr<osg::Texture> texture;
    osg::ref_ptr<osg::TexMat> matrix;
    bool isOff = false;       ///< A StateSet says that the texture's mode is off.
    bool isGenerated = false; ///< A TexGen makes the coordinates.

    bool operator==(const TextureUnit& other) const
    {
        return texture == other.texture && matrix == other.matrix && isOff == other.isOff &&
               isGenerated == other.isGenerated;
    }
    bool operator!=(const TextureUnit& other) const { return !(*this == other); }
};

/// The texture units along a path, as osg::State resolves them: the nearer StateSet wins, unless
/// one above has OVERRIDE and the nearer one is not PROTECTED.
class TextureState
{
public:
    void push(const osg::StateSet* stateSet);
    void pop();

    unsigned int getUnits() const { return static_cast<unsigned int>(_stack.back().size()); }
    TextureUnit get(unsigned int unit) const;

private:
    struct Entry
    {
        TextureUnit unit;
        bool textureFixed = false, matrixFixed = false, offFixed = false, generatedFixed = false;
    };
    static void merge(Entry& entry, const osg::StateSet& stateSet, unsigned int unit);

    std::vector<std::vector<Entry>> _stack{{}};
};

/// Goes to each drawable, on each path, with the texture units there.
class TextureStateVisitor : public osg::NodeVisitor
{
public:
    TextureStateVisitor() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override;
    void apply(osg::Drawable& drawable) override;

protected:
    virtual void visit(osg::Drawable& drawable, const TextureState& state) = 0;

private:
    TextureState _state;
};

} // namespace osgPagedTexture
