// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/State>

namespace osgMultiRender
{

/// How a pass sets and unsets what no leaf below may change.
constexpr auto ForcedOn = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
constexpr auto ForcedOff = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE;

/// A StateSet that is pushed as long as this lives, for what is made for one pass and goes with it.
///
/// osg::State tells attributes apart by their addresses: one that comes to lie where a dead one was
/// counts as applied, and GL keeps what the dead one has set. What the StateSet has is therefore
/// forgotten in the end, and applied anew by the next State::apply(). In the draw thread.
class OSGMULTIRENDER_EXPORT PassState
{
public:
    PassState(osg::State& state, const osg::StateSet& stateSet);
    ~PassState();
    PassState(const PassState&) = delete;
    PassState& operator=(const PassState&) = delete;

private:
    osg::State& _state;
    const osg::ref_ptr<const osg::StateSet> _stateSet;
};

} // namespace osgMultiRender
