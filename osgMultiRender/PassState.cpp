// SPDX-License-Identifier: MIT
#include <osgMultiRender/PassState.h>

#include <osg/StateSet>

namespace osgMultiRender
{

PassState::PassState(osg::State& state, const osg::StateSet& stateSet)
    : _state(state), _stateSet(&stateSet)
{
    _state.pushStateSet(_stateSet.get());
}

PassState::~PassState()
{
    _state.popStateSet();
    for (const auto& [type, attribute] : _stateSet->getAttributeList())
        _state.haveAppliedAttribute(type.first, type.second);
    const osg::StateSet::TextureAttributeList& units = _stateSet->getTextureAttributeList();
    for (unsigned int unit = 0; unit < units.size(); ++unit)
        for (const auto& [type, attribute] : units[unit])
            _state.haveAppliedTextureAttribute(unit, type.first, type.second);
}

} // namespace osgMultiRender
