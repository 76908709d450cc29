// Two triangles per segment, without attributes: the segment, end and side of a vertex.
int segment = gl_VertexID / 6, corner = gl_VertexID % 6;
bool at_end = corner == 1 || corner == 2 || corner == 4;
float side = corner == 0 || corner == 1 || corner == 3 ? -1.0 : 1.0;

const vec4 kOutside = vec4(0.0, 0.0, -2.0, 1.0); // outside the picture: segments with all vertices here are not drawn
