// Positions of the taps of the occlusion. The same for all pixels: no vectors.

// Direction of the first tap: sixteen directions within four by four pixels.
float first_turn(int column, int row) {
    int fine = ((row & 1) << 1) | ((row >> 1) & 1); // 0, 2, 1, 3
    return 0.39269908F * float(4 * ((column + row) & 3) + fine);
}

// Distance of a tap as a share of the reach. Denser towards the centre: contacts count more than far neighbours.
float tap_distance(int i, int taps) {
    float fraction = (float(i) + 0.5F) / float(taps);
    return fraction * sqrt(fraction);
}
