// SPDX-License-Identifier: MIT
#pragma once

namespace osgLabels
{

/// Texture units of osgLabels while leaves are drawn. A model has 0 to 3, osgShadowVolume 9 and 12
/// to 15 then; it uses 10 and 11 before. Fragment shaders have 16 in OpenGL 3.3, all stages 48.
enum LabelUnits
{
    RowsUnit = 4,
    TextsUnit = 5,
    RecordsUnit = 6, ///< Object records of a PrimitiveBatch.
    GlyphsUnit = 7,
    ObjectsUnit = 8, ///< Object records of all.
    StylesUnit = 10,
    FramesUnit = 11, ///< Second pass only, as are those of LabelTargets.
    ColorsUnit = 16  ///< Of a PrimitiveBatch; read by vertex shaders only.
};

} // namespace osgLabels
