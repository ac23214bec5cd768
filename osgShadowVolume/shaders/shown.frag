// A volume as a translucent surface; edges that count several times are denser.

flat in float osgsv_multiplicity;
uniform vec4 osgsv_color;
layout(location = 0) out vec4 osgsv_shown;

void main()
{
    osgsv_shown = vec4(osgsv_color.rgb, min(0.9, osgsv_color.a * abs(osgsv_multiplicity)));
}
