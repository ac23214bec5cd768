// Direct illuminance of this fragment in lux: in place of the fixed function's light, the inverse
// square law, Lambert's cosine with the side that is seen, and cos^exponent within a spot's cutoff.
// Follows lights.frag; texel 5 of a light has lux at one unit of distance in z, negative where the
// light does not say.

#ifdef OSGSV_FALSE_COLORS
uniform float osgsv_maximum; // lux at the top of the false colours
#endif

float osgsv_lux = 0.0;
bool osgsv_isUnknown = false;

#if !defined(OSGSV_UNIFORM) || OSGSV_UNIFORM > 0
// The unit normal on the side that is seen; the triangle's own where the model has none. Takes
// derivatives: call it where all fragments of a triangle pass, before any light.
vec3 osgsv_seenNormal(osgmr_Lit surface)
{
    vec3 face = cross(dFdx(surface.position), dFdy(surface.position));
    bool isPerspective = gl_ProjectionMatrix[3][3] == 0.0;
    if (dot(face, isPerspective ? -surface.position : vec3(0.0, 0.0, 1.0)) < 0.0)
        face = -face;
#ifndef OSGSV_FACE_NORMALS
    if (surface.normal != vec3(0.0))
        return dot(surface.normal, face) < 0.0 ? -surface.normal : surface.normal;
#endif
    float size = length(face);
    return size > 0.0 ? face / size : face;
}

// `surface` has the normal that is seen.
void osgsv_addLight(int light, float type, osgmr_Lit surface, inout vec3 ambient, inout vec3 diffuse,
                    inout vec3 specular)
{
    vec4 position = OSGSV_LIGHT(light, 0);
    float lux = OSGSV_LIGHT(light, 5).z;
    if (lux < 0.0)
    {
        osgsv_isUnknown = true;
        return;
    }
    vec3 toLight = position.xyz;
    if (type == 1.0 || type == 2.0)
    {
        toLight = position.xyz - surface.position;
        float distance = length(toLight);
        if (distance == 0.0)
            return;
        toLight /= distance;
        lux = lux / distance / distance;
    }
    if (type > 1.5)
    {
        vec4 spot = OSGSV_LIGHT(light, 4);
        float exponent = OSGSV_LIGHT(light, 5).x;
        float c = dot(-toLight, spot.xyz);
        lux *= c < spot.w ? 0.0 : exponent == 0.0 ? 1.0 : pow(max(c, 0.0), exponent);
    }
    lux *= max(dot(surface.normal, toLight), 0.0);
#ifdef OSGSV_SHADOWS
    float shadow = OSGSV_LIGHT(light, 5).y;
    if (shadow >= 0.0 && lux > 0.0)
        lux *= osgsv_visible(shadow, surface.position);
#endif
    osgsv_lux += lux;
}
#endif

// Alpha stays the surface's, so that an alpha test cuts out what it cuts out of the picture.
vec4 osgmr_output(vec4 surface)
{
    if (osgsv_isUnknown)
        return vec4(1.0, 0.0, 1.0, surface.a);
#ifdef OSGSV_FALSE_COLORS
    return vec4(osgsv_falseColor(osgsv_lux / osgsv_maximum), surface.a);
#else
    return vec4(vec3(osgsv_lux), surface.a);
#endif
}
