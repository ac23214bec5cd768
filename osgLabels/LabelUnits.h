// SPDX-License-Identifier: MIT
#pragma once

namespace osgLabels
{

/// Texture units of osgLabels while leaves are drawn. A model has 0 to 3, osgShadowVolume 9 to 15. Fragment
/// shaders have 16 in OpenGL 3.3, all stages together 48.
enum LabelUnits
{
    RowsUnit = 4,
    TextsUnit = 5,
    RecordsUnit = 6, ///< Object records.
    GlyphsUnit = 7,
    StylesUnit = 8,
    ColorsUnit = 16 ///< Of a PrimitiveBatch; read by vertex shaders only.
};

} // namespace osgLabels
