// Members of the uniform block Planes; C++ includes this file by render/scene/uniform_blocks.h. Rows of each plane.
// Those marked with * are applied to (x, y, 1) of a pixel:
//   0, 1 *    position across and down, 0 to 1, times the weight; w: size of the picture, 0 without a picture
//   2 *       the weight, positive in front of the eye
//   3 *       value in the depth buffer; w: width of the outline, pixels
//   4         colour of the outline, sRGB
//   5         box in the picture that contains the plane and its outline: least x, y, most x, y
//   6, 7      values in the depth buffer at the first and at the second end of the four edges
//   8 to 11   the edges in the picture: first end, second end
//   12 to 15* distance from the lines through the edges, pixels, positive inside; w of 12: how much the value in the
//             depth buffer changes at most from a pixel's middle to a sample
vec4 plane_rows[kMostPlanes * kPlaneRows];
vec4 plane_counts; // number of planes; shift of the view from the first one, pixels: pictures are read without it
