// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/MixTexels.h>

#include <osg/Array>
#include <osg/Matrixd>
#include <osg/StateSet>
#include <osg/TextureBuffer>
#include <osg/Uniform>

#include <string>

namespace osgMultiRender
{

/// The key points and weights of one view on the GPU: a StateSet with what mix.glsl reads.
///
/// A node that mixes renderings has one MixState a view, because positions are relative to the
/// eye, and puts the StateSet above the leaves that it draws with a program that contains
/// getSource(). Nothing that changes here compiles or links a program: texels and uniforms do it
/// all, from no key point to KeyPoints::MaxPoints, in any mode, with any ranges and rules. Only the
/// renderings that a program contains are its own.
///
/// Requires GLSL 3.30 (compatibility) and, for more than some 20,000 segments, more texels in a
/// buffer texture than the 65536 that OpenGL promises; all drivers of today have 2^27.
class OSGMULTIRENDER_EXPORT MixState : public osg::Referenced
{
public:
    /// `unit` is the texture unit of the sampler osgmr_mix.
    explicit MixState(unsigned int unit);

    /// mix.glsl, without a #version line. OSG_FILE_PATH may lead to another one.
    static std::string getSource();

    /// Takes the values for the next drawing; `keysToEye` as in MixTexels::set(). Some 0.2 ms for
    /// 10,000 segments. Not while a thread draws with the StateSet: it is DYNAMIC, so that
    /// osgViewer waits for that.
    void update(const KeyPoints& points, const MixWeights& weights, const osg::Matrixd& keysToEye);

    osg::StateSet* getStateSet() { return _stateSet.get(); }
    const MixTexels& getTexels() const { return _values; } ///< As of the last update().

protected:
    ~MixState() override = default;

private:
    MixTexels _values;
    osg::ref_ptr<osg::Vec4uiArray> _texels;
    osg::ref_ptr<osg::Vec4iArray> _cells;       ///< In the same buffer, behind the texels.
    std::shared_ptr<const KeyCells> _sentCells; ///< What is in it.
    osg::ref_ptr<osg::Uniform> _frame, _keys, _rules, _background, _roots, _grids, _listed;
    osg::ref_ptr<osg::StateSet> _stateSet;
};

} // namespace osgMultiRender
