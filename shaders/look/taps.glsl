// Where the taps of the occlusion lie. The same for all pixels: no vectors.

// Which way the first tap lies from a pixel: sixteen ways within four by four pixels.
float first_turn(int column, int row) {
    int fine = ((row & 1) << 1) | ((row >> 1) & 1); // 0, 2, 1, 3
    return 0.39269908F * float(4 * ((column + row) & 3) + fine);
}

// How far a tap lies away, of the reach. Denser towards the centre: contacts count more than far neighbours.
float tap_distance(int i, int taps) {
    float fraction = (float(i) + 0.5F) / float(taps);
    return fraction * sqrt(fraction);
}
