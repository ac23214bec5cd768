// Counts surfaces of volumes: in with one sign, out with the other.

flat in float osgsv_multiplicity;
layout(location = 0) out float osgsv_count;

void main()
{
    osgsv_count = gl_FrontFacing ? osgsv_multiplicity : -osgsv_multiplicity;
}
