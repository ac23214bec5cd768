// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <map>
#include <string>
#include <vector>

namespace osgMultiRender
{

/// What became of one light, label, rendering, texture or program variant in a frame.
struct PlanEntry
{
    enum class Decision
    {
        Drawn,  ///< It has a pass, or a share of one, of its own.
        Folded, ///< It is part of another one's pass.
        Dropped ///< Nothing is allocated, compiled, uploaded or drawn for it.
    };

    std::string subject; ///< "light 3 'lamp'", "variant lighting=pixel tex0", …
    Decision decision = Decision::Drawn;
    std::string reason; ///< One clause: "its cone misses the view".
};

/// What a kit drew, folded and dropped for one view of one frame, and why.
struct Plan
{
    std::string kit;        ///< "osgShadowVolume::LitScene".
    std::string view;       ///< Name of the camera, or "camera N" by order of appearance.
    unsigned int frame = 0; ///< Frame number of the last draw of this view.
    std::vector<PlanEntry> entries;
    std::map<std::string, double> counts; ///< "passes", "drawCalls", "programs.compiled", …
};

/// Something that plans what it draws; a kit's Group implements it beside osg::Group.
class OSGMULTIRENDER_EXPORT Planned
{
public:
    virtual ~Planned();

    /// The plan of the last drawn frame of each view. Callable from any thread.
    virtual std::vector<Plan> getPlans() const = 0;
};

/// "drawn", "folded" or "dropped".
OSGMULTIRENDER_EXPORT const char* toString(PlanEntry::Decision decision);

/// The plan as text, one entry a line, for OSG_INFO and `osgrender --list-plan`.
OSGMULTIRENDER_EXPORT std::string toString(const Plan& plan);

} // namespace osgMultiRender
