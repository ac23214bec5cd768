// What a label does to the colour of a surface.

uniform vec4 osgLabels_styles[64]; // by style: ink, plate, outline width and colour, readable size
uniform float osgLabels_opacity;

// Relative luminance of an sRGB colour (WCAG 2.1).
float osgLabels_luminance(vec3 color)
{
    vec3 low = color / 12.92;
    vec3 high = pow((color + 0.055) / 1.055, vec3(2.4));
    return dot(mix(low, high, step(0.04045, color)), vec3(0.2126, 0.7152, 0.0722));
}
