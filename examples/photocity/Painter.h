// SPDX-License-Identifier: MIT
#pragma once

#include "../city/CityRandom.h"
#include "Picture.h"
#include "Sources.h"

#include <array>
#include <vector>

/// Paints a picture row by row: a piece of a photograph, turned, scaled and in other colours, with
/// the grain of a camera and what its use asks for: windows and a door, lane markings, paving.
///
/// The same picture and sources give the same bytes. It keeps no pixels: rows may be taken in any
/// order and in several threads, at any size. The sources must outlive it.
class Painter
{
public:
    Painter(const Picture& picture, const std::vector<Source>& sources);

    /// Row `y` from the top: three channels a pixel, one for a grey picture.
    void paint(int y, std::uint8_t* row) const;

    /// The photograph alone at a pixel of the picture: red in the lowest byte.
    std::uint32_t sample(int x, int y) const;

private:
    /// A pixel's part is the lesser one of its column's and its row's.
    enum Part : std::uint8_t
    {
        Wall,
        Frame,
        Pane,
        PartCount
    };
    /// What becomes of a channel's value, by value + grain.
    using Curve = std::array<std::uint8_t, 320>;
    using Marks = std::vector<std::uint8_t>;

    void choosePiece();
    void chooseCurves();
    void setCurve(Part part, double gain, double offset);
    void mark();
    void markFacade();

    Picture _picture;
    CityRandom _random;
    const Source& _source;
    /// In 1/65536 of the source's pixels: where the first pixel lies, and steps.
    std::int64_t _u = 0, _v = 0, _uAcross = 0, _vAcross = 0, _uDown = 0, _vDown = 0;
    std::array<std::array<Curve, 3>, PartCount> _curves;
    Marks _columns, _rows, _door;
    int _doorTop; ///< The row from which on the door's columns count.
};
