// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixState.h>

#include <osgMultiRender/Shaders.h>

#include <osg/Shader>
#include <osgDB/ReadFile>

#include <cstring>

namespace osgMultiRender
{

namespace
{

glm::dmat4 toGlm(const osg::Matrixd& matrix)
{
    // OSG's row vectors in rows are GLM's column vectors in columns.
    glm::dmat4 result;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            result[row][column] = matrix(row, column);
    return result;
}

void setInts(osg::Uniform& uniform, const glm::ivec4& values)
{
    uniform.set(values.x, values.y, values.z, values.w);
}

} // namespace

MixState::MixState(unsigned int unit)
    : _texels(new osg::Vec4uiArray(1)), _cells(new osg::Vec4iArray(1)),
      _frame(new osg::Uniform(osg::Uniform::FLOAT_MAT3, "osgmr_mixFrame")),
      _keys(new osg::Uniform(osg::Uniform::INT_VEC4, "osgmr_mixKeys")),
      _rules(new osg::Uniform(osg::Uniform::INT_VEC4, "osgmr_mixRules")),
      _background(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "osgmr_mixBackground")),
      _roots(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "osgmr_mixRoots", 2)),
      _grids(new osg::Uniform(osg::Uniform::INT_VEC4, "osgmr_mixCells")),
      _listed(new osg::Uniform(osg::Uniform::INT_VEC4, "osgmr_mixListed")),
      _stateSet(new osg::StateSet)
{
    const osg::ref_ptr<osg::TextureBuffer> texture = new osg::TextureBuffer(_texels);
    // OSG leaves the buffer bound when it has sent changes. As GL_ARRAY_BUFFER it would turn the
    // addresses of the next drawable's arrays into offsets.
    _texels->getBufferObject()->setTarget(GL_TEXTURE_BUFFER_ARB);
    // Of one buffer OSG sends only the part that has changed: the cells stay while the eye moves.
    _cells->setBufferObject(_texels->getBufferObject());
    texture->setUserData(_cells); // the StateSet may outlive this; a buffer does not own its parts
    texture->setInternalFormat(GL_RGBA32UI_EXT);
    _stateSet->setDataVariance(osg::Object::DYNAMIC);
    // PROTECTED: the one of a kit around this one may be above.
    _stateSet->setTextureAttribute(unit, texture,
                                   osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED);
    _stateSet->addUniform(new osg::Uniform("osgmr_mix", static_cast<int>(unit)));
    for (osg::Uniform* uniform : {_frame.get(), _keys.get(), _rules.get(), _background.get(),
                                  _roots.get(), _grids.get(), _listed.get()})
        _stateSet->addUniform(uniform);
    update(KeyPoints(), MixWeights(), osg::Matrixd());
}

std::string MixState::getSource()
{
    return osgDB::readRefShaderFileWithFallback(osg::Shader::FRAGMENT, "osgMultiRender/mix.glsl",
                                                shaders::mix_glsl)
        ->getShaderSource();
}

void MixState::update(const KeyPoints& points, const MixWeights& weights,
                      const osg::Matrixd& keysToEye)
{
    _values.set(points, weights, toGlm(keysToEye));
    const std::size_t bytes = _values.texels.size() * sizeof(glm::uvec4);
    if (_texels->size() != _values.texels.size() ||
        std::memcmp(_texels->getDataPointer(), _values.texels.data(), bytes) != 0)
    {
        _texels->resize(_values.texels.size());
        std::memcpy(static_cast<void*>(&_texels->front()), _values.texels.data(), bytes);
        _texels->dirty();
    }
    if (_values.cells && _sentCells != _values.cells)
    {
        const std::vector<std::int32_t>& cells = _values.cells->getCells();
        _cells->resize((cells.size() + 3) / 4);
        std::memcpy(static_cast<void*>(&_cells->front()), cells.data(), 4 * cells.size());
        _cells->dirty();
        _texels->dirty(); // what the texture looks at
        _sentCells = _values.cells;
    }
    for (unsigned int i = 0; i < 2; ++i)
    {
        const glm::vec4& root = _values.roots[i];
        _roots->setElement(i, osg::Vec4(root.x, root.y, root.z, root.w));
    }
    setInts(*_grids, _values.grids);
    setInts(*_listed, _values.listed);
    osg::Matrix3 frame;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            frame(column, row) = _values.frame[column][row];
    _frame->set(frame);
    setInts(*_keys, _values.keys);
    setInts(*_rules, _values.rules);
    const glm::vec4& background = _values.background;
    _background->set(osg::Vec4(background.r, background.g, background.b, background.a));
}

} // namespace osgMultiRender
