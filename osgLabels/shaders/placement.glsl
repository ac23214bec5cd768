// The round shapes, and osgLabels_placeOn() itself. Comes after placementFaces.glsl.

// A part of a cone around the z axis, or of a cylinder: its unrolled sector of a plane.
struct osgLabels_Band
{
    vec2 tangent;    // Of the generator: radius and z.
    vec2 middle;     // Of the generator.
    float room;      // Length of the generator.
    float narrowest; // Radius at its narrow end.
    bool around;     // Whether text runs around, else along the generator.
};

// Of a point: its place t on the generator from the middle (with `base` to be added), and the
// gradient of t.
osgLabels_Line osgLabels_unroll(osgLabels_View view, vec3 p, osgLabels_Band band, float base,
                                float t, vec3 gradT, float width)
{
    osgLabels_Line line;
    float radius = band.middle.x;
    float slope = band.tangent.x;
    float steep = abs(slope);
    // Four texts around, each with a quarter of the circle.
    float along = osgLabels_em(view, band.room, osgLabels_HalfPi * band.narrowest, width);
    float inner = max(radius - 0.5f * steep * view.height * band.room, 0.3f * radius);
    float around = osgLabels_em(view, osgLabels_HalfPi * inner, band.room, width);
    // A straight text bends towards the ends of the generator, and must keep off them.
    float bent = 0.125f * width * width * steep / max(radius, osgLabels_Tiny);
    around = min(around, 0.95f * band.room / (0.5f + sqrt(0.25f + 1.9f * bent * band.room)));
    // On what stands upright, text around is level, which is worth a third of its size.
    float least = abs(view.up.z) > 0.7071f * length(view.up) ? 0.75f : 1.5f;
    bool isLong = band.room > osgLabels_Long * osgLabels_HalfPi * radius;
    bool runsAround = band.around || (around > least * along && !isLong);
    line.em = runsAround ? around : along;

    float rho = max(length(vec2(p.x, p.y)), osgLabels_Tiny);
    float theta = atan(p.y, p.x);
    vec3 gradTheta = vec3(-p.y, p.x, 0.0f) / (rho * rho);
    float count = 4.0f;
    if (runsAround)
        count = max(count, osgLabels_count(view, osgLabels_TwoPi * max(radius - steep * line.em, inner),
                                           line.em, width));
    float turned = runsAround ? osgLabels_fromMiddle(0.0f, theta, count, osgLabels_TwoPi / count)
                              : osgLabels_fromMiddle(0.0f, theta, 1.0f, osgLabels_HalfPi);
    float turn = theta - turned;

    float angle = slope * turned;
    float here = radius + slope * t;
    float sine = sin(0.5f * angle);
    float w = steep > 1e-5f ? here * sin(angle) / slope : here * turned;
    float sagged = t - (steep > 1e-5f ? 2.0f * here * sine * sine / slope : 0.0f);
    vec3 gradW = here * cos(angle) * gradTheta + sin(angle) * gradT;
    vec3 gradSagged = cos(angle) * gradT - here * sin(angle) * gradTheta;

    vec3 outward = vec3(cos(turn), sin(turn), 0.0f);
    line.middle = radius * outward + vec3(0.0f, 0.0f, band.middle.y);
    line.axis = vec3(0.0f, 0.0f, 1.0f);
    line.bend = runsAround ? vec2(radius, slope) : vec2(0.0f);
    if (runsAround)
    {
        line.at = vec2(w, base + sagged);
        line.along = gradW;
        line.across = gradSagged;
        line.direction = vec3(-outward.y, outward.x, 0.0f);
        line.beyond = 0.0f;
    }
    else
    {
        count = osgLabels_count(view, band.room, line.em, width);
        line.at = vec2(osgLabels_fromMiddle(base, sagged, count,
                                            osgLabels_period(band.room, count)),
                       w);
        line.along = gradSagged;
        line.across = gradW;
        line.direction = slope * outward + vec3(0.0f, 0.0f, band.tangent.y);
        line.beyond = abs(base + sagged) - 0.5f * band.room;
    }
    return line;
}

// Along the generator from its middle, by projection onto it.
osgLabels_Line osgLabels_project(osgLabels_View view, vec3 p, osgLabels_Band band, float width)
{
    float rho = max(length(vec2(p.x, p.y)), osgLabels_Tiny);
    float t = dot(vec2(rho, p.z) - band.middle, band.tangent);
    vec3 gradT = vec3(band.tangent.x * p.x / rho, band.tangent.x * p.y / rho, band.tangent.y);
    return osgLabels_unroll(view, p, band, 0.0f, t, gradT, width);
}

// Of radii at both ends and half length. `flatness` is how much of the normal, 0 to 1, lies along z.
osgLabels_Line osgLabels_frustum(osgLabels_View view, vec3 p, float flatness, vec3 size, float width)
{
    vec3 q = p + view.base;
    vec2 generator = vec2(size.y - size.x, 2.0f * size.z);
    float slant = max(length(generator), osgLabels_Tiny);
    osgLabels_Band band;
    band.tangent = generator / slant;
    if (flatness > 0.5f + 0.5f * abs(band.tangent.x))
        return osgLabels_disc(view, p, q.z > 0.0f ? size.z : -size.z, q.z > 0.0f ? size.y : size.x,
                              width);
    // No text on what is narrower than a third of the wide end.
    float wide = max(size.x, size.y);
    band.narrowest = max(min(size.x, size.y), 0.35f * wide);
    band.room = slant * (wide > band.narrowest
                             ? (wide - band.narrowest) / max(abs(generator.x), osgLabels_Tiny)
                             : 1.0f);
    float off = (generator.x < 0.0f ? -0.5f : 0.5f) * (slant - band.room);
    band.middle = vec2(0.5f * (size.x + size.y), 0.0f) + off * band.tangent;
    band.around = false;
    if (size.x == size.y)
        return osgLabels_unroll(view, q, band, view.base.z, p.z, vec3(0.0f, 0.0f, 1.0f), width);
    return osgLabels_project(view, q, band, width);
}

// Around the axis of the frame that is nearest to up.
osgLabels_Line osgLabels_sphere(osgLabels_View view, vec3 p, float radius, float width)
{
    vec3 x = vec3(1.0f, 0.0f, 0.0f);
    vec3 y = vec3(0.0f, 1.0f, 0.0f);
    vec3 z = vec3(0.0f, 0.0f, 1.0f);
    vec3 up = abs(view.up);
    mat3 axes = 1.002f * up.z >= max(up.x, up.y) ? mat3(x, y, z)
                : 1.002f * up.y >= up.x          ? mat3(z, x, y)
                                                 : mat3(y, z, x);
    vec3 q = (p + view.base) * axes;
    osgLabels_Band band;
    band.tangent = vec2(0.0f, 1.0f);
    band.middle = vec2(radius, 0.0f);
    band.room = radius;
    band.narrowest = radius;
    band.around = true;
    // Mercator's: letters keep their shape, and are a little smaller off the equator.
    float away = max(length(q), osgLabels_Tiny);
    float s = clamp(q.z / away, -0.999f, 0.999f);
    vec3 gradS = (z - s * q / away) / away;
    osgLabels_Line line = osgLabels_unroll(view, q, band, 0.0f, radius * atanh(s),
                                           radius / (1.0f - s * s) * gradS, width);
    line.along = axes * line.along;
    line.across = axes * line.across;
    line.middle = axes * line.middle;
    line.direction = axes * line.direction;
    line.axis = axes * line.axis;
    return line;
}

// Half an ellipsoid: text on the cone that touches it at 40 degrees.
osgLabels_Line osgLabels_dish(osgLabels_View view, vec3 p, float flatness, vec3 size, float width)
{
    vec3 q = p + view.base;
    if (flatness > 0.99f && q.z < 0.02f * size.z)
        return osgLabels_disc(view, p, 0.0f, size.x, width);
    osgLabels_Band band;
    vec2 generator = vec2(-0.6427876f * size.x, 0.7660444f * size.z);
    float speed = max(length(generator), osgLabels_Tiny);
    band.tangent = generator / speed;
    band.middle = vec2(0.7660444f * size.x, 0.6427876f * size.z);
    band.room = 0.8f * speed;
    band.narrowest = band.middle.x;
    band.around = true;
    return osgLabels_project(view, q, band, width);
}

// Four lines along the tube, each as long as its own arc; angles count from the middle of the arc.
osgLabels_Line osgLabels_torus(osgLabels_View view, vec3 p, vec3 size, float width)
{
    osgLabels_Line line;
    p += view.base;
    float bisector = 0.5f * size.z;
    vec2 mid = vec2(cos(bisector), sin(bisector));
    vec2 xy = vec2(mid.x * p.x + mid.y * p.y, mid.x * p.y - mid.y * p.x);
    float rho = max(length(xy), osgLabels_Tiny);
    float theta = atan(xy.y, xy.x);
    vec3 outward = vec3(p.x / rho, p.y / rho, 0.0f);
    vec3 gradTheta = vec3(-outward.y, outward.x, 0.0f) / rho;
    vec2 tube = vec2(rho - size.x, p.z);
    float psi = atan(tube.y, tube.x);
    float thick = max(dot(tube, tube), osgLabels_Tiny);
    vec3 gradPsi = (tube.x * vec3(0.0f, 0.0f, 1.0f) - tube.y * outward) / thick;
    // Of the line, not of the point: rounding must not differ within a text.
    float psi0 = osgLabels_HalfPi * floor(psi / osgLabels_HalfPi + 0.5f);
    float off = psi - psi0;

    float ring = max(size.x + size.y * cos(psi0), 0.1f * size.y);
    float room = ring * size.z;
    line.em = osgLabels_em(view, room, osgLabels_HalfPi * size.y, width);
    float count = osgLabels_count(view, room, line.em, width);
    float turned = osgLabels_fromMiddle(0.0f, theta, count, size.z / count);
    // Where the ring is narrower than on the line, letters are so too: across as well as along.
    float narrow = size.y * sin(psi0) / ring;
    line.at = vec2(ring * turned, size.y * off * (1.0f + 0.5f * narrow * off));
    line.along = ring * gradTheta;
    line.across = size.y * (1.0f + narrow * off) * gradPsi;
    float theta0 = bisector + theta - turned;
    vec2 turn = vec2(cos(theta0), sin(theta0));
    line.middle = vec3(ring * turn.x, ring * turn.y, size.y * sin(psi0));
    line.direction = vec3(-turn.y, turn.x, 0.0f);
    line.beyond = 0.0f;
    line.axis = vec3(0.0f, 0.0f, 1.0f);
    line.bend = vec2(ring, 0.0f);
    return line;
}

// Texture coordinates: their axes are those of the text. The rotation's x and y hold the lengths of
// a unit of the coordinates.
osgLabels_Line osgLabels_textured(osgLabels_View view, vec3 p, vec3 size, float width)
{
    osgLabels_Line line;
    line.em = osgLabels_em(view, 2.0f * size.x, 2.0f * size.y, width);
    float count = osgLabels_count(view, 2.0f * size.x, line.em, width);
    line.at = vec2(osgLabels_fromMiddle(0.0f, p.x, count, 2.0f * size.x / count), p.y);
    line.along = vec3(1.0f, 0.0f, 0.0f);
    line.across = vec3(0.0f, 1.0f, 0.0f);
    line.middle = vec3(0.0f);
    line.direction = vec3(0.0f);
    line.beyond = 0.0f;
    line.axis = vec3(0.0f);
    line.bend = vec2(0.0f);
    return line;
}

// A scene's second pass knows the shapes that it has, by bits; all others all. A constant, so that
// compilers leave out what is behind it.
#ifndef OSGLABELS_SHAPES
#define OSGLABELS_SHAPES 0x7ff
#endif

bool osgLabels_is(uint shape, uint which)
{
    return (uint(OSGLABELS_SHAPES) >> which & 1u) != 0u && shape == which;
}

osgLabels_Line osgLabels_lineOf(osgLabels_View view, uint shape, vec3 p, vec3 normal, vec3 size,
                                uint rooms, float width)
{
    float flatness = abs(normal.z) / max(length(normal), osgLabels_Tiny);
    if (osgLabels_is(shape, 2u) || osgLabels_is(shape, 5u))
        return osgLabels_frustum(view, p, flatness,
                                 vec3(size.x, shape == 2u ? size.x : size.y, size.z), width);
    if (osgLabels_is(shape, 3u))
        return osgLabels_sphere(view, p, size.x, width);
    if (osgLabels_is(shape, 4u))
        return osgLabels_dish(view, p, flatness, size, width);
    if (osgLabels_is(shape, 6u))
        return osgLabels_pyramid(view, p, flatness, size, width);
    if (osgLabels_is(shape, 7u))
        return osgLabels_torus(view, p, size, width);
    if (osgLabels_is(shape, 8u))
        normal = vec3(0.0f, 0.0f, 1.0f);
    return osgLabels_box(view, p, normal, size, rooms, width);
}

// Where a point of an object lies on its label, a text of `width` em. `position` is relative to the
// object's origin and view.base, dx and dy are its changes by a pixel; all in local coordinates.
osgLabels_Place osgLabels_placeOn(osgLabels_Object object, vec3 position, vec3 dx, vec3 dy,
                                  osgLabels_View view, float width)
{
    osgLabels_Place result;
    result.inside = false;
    result.place = vec2(0.0f);
    result.footprint = mat2(0.0f);
    for (int i = 0; i < 3; ++i)
        result.onLine[i] = position;
    uint shape = object.shape & 0xffu;
    if (shape == 0u || !(width > 0.0f))
        return result;

    osgLabels_Line line;
    vec4 r = object.rotation;
    float turned = 1.0f;
    if (shape == 10u)
    {
        vec3 unit = vec3(r.x, r.y, 0.0f);
        dx *= unit;
        dy *= unit;
        line = osgLabels_textured(view, position * unit, object.size, width);
    }
    else
    {
        vec3 twice = 2.0f * vec3(r);
        mat3 frame = mat3(1.0f - twice.y * r.y - twice.z * r.z, twice.x * r.y + twice.z * r.w,
                          twice.x * r.z - twice.y * r.w, twice.x * r.y - twice.z * r.w,
                          1.0f - twice.x * r.x - twice.z * r.z, twice.y * r.z + twice.x * r.w,
                          twice.x * r.z + twice.y * r.w, twice.y * r.z - twice.x * r.w,
                          1.0f - twice.x * r.x - twice.y * r.y);
        vec3 p = frame * position;
        dx = frame * dx;
        dy = frame * dy;
        vec3 eye = frame * vec3(view.eye);
        view.eye = vec4(eye, view.eye.w);
        view.base = frame * view.base;
        view.up = frame * view.up;
        view.screenUp = frame * view.screenUp;
        view.screenRight = frame * view.screenRight;
        vec3 normal = cross(dx, dy);
        normal /= max(max(abs(normal.x), max(abs(normal.y), abs(normal.z))), 1e-37f);
        line = osgLabels_lineOf(view, shape, p, normal, object.size, object.shape >> 9u, width);
        for (int i = 0; i < 3; ++i)
        {
            float s = (float(i) - 1.0f) * 0.3333333f * width * line.em;
            result.onLine[i] = position + osgLabels_toLine(line, p + view.base, s) * frame;
        }

        // The line's direction on the screen, seen from anywhere along it, within 90 degrees of
        // one that rises by 22.5: so text on what stands upright, which is level with neither side,
        // reads upwards, however the camera trembles.
        vec3 upright = 0.9238795f * view.screenUp - 0.3826834f * view.screenRight;
        vec3 onScreen = cross(eye - view.eye.w * line.middle, line.direction);
        float seen = dot(cross(view.screenRight, view.screenUp),
                         eye - view.eye.w * (p + view.base));
        turned = (dot(onScreen, upright) < 0.0f) == (seen < 0.0f) ? 1.0f : -1.0f;
    }

    float perEm = 1.0f / max(line.em, osgLabels_Tiny);
    mat2 footprint = perEm * mat2(dot(line.along, dx), dot(line.across, dx), dot(line.along, dy),
                                  dot(line.across, dy));
    // Not mirrored, from whichever side and through whichever matrix it is seen.
    float mirrored = determinant(footprint) < 0.0f ? -1.0f : 1.0f;
    vec2 side = shape == 10u ? vec2(mirrored, 1.0f) : vec2(turned, turned * mirrored);
    result.footprint = mat2(side * footprint[0], side * footprint[1]);
    result.place = side * line.at * perEm + vec2(0.5f * width, 0.5f);
    result.inside = line.em > 0.0f && line.beyond <= 0.0f && result.place.x >= 0.0f &&
                    result.place.x <= width && result.place.y >= 0.0f && result.place.y <= 1.0f;
    return result;
}
