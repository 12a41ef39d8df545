// Arithmetic in double and in 128-bit integers that no device may round otherwise than the CPU does.
//
// Sums and products of doubles are rounded to nearest everywhere; quotients are only near. Whole numbers are held in
// doubles as long as they are below 2^53.

const double whole_magic = 6755399441055744.0LF;  // 1.5 * 2^52

/// To the nearest whole number, ties to even, for |x| below 2^51.
double rounded(double x) {
    precise double sum = x + whole_magic;
    precise double r = sum - whole_magic;
    return r;
}

/// high 2^21 + low, 0 <= low < 2^21.
struct Wide {
    int64_t high;
    int64_t low;
};

const int64_t low_mask = 0x1FFFFFL;

/// a b - c d of whole numbers up to 2^41.
Wide wide_cross(double a, double b, double c, double d) {
    int64_t ia = int64_t(a);
    int64_t ib = int64_t(b);
    int64_t ic = int64_t(c);
    int64_t id = int64_t(d);
    // Each product with a low half is below 2^62.
    int64_t low = ia * (ib & low_mask) - ic * (id & low_mask);
    return Wide(ia * (ib >> 21) - ic * (id >> 21) + (low >> 21), low & low_mask);
}

/// -1, 0 or 1.
int sign_of(Wide x) { return x.high < 0L ? -1 : x.high > 0L || x.low > 0L ? 1 : 0; }

/// Rounded once, to nearest, ties to even.
double wide_to_double(Wide x) {
    bool negative = x.high < 0L;
    int64_t low = negative ? -x.low & low_mask : x.low;
    int64_t high = negative ? -x.high - (x.low != 0L ? 1L : 0L) : x.high;
    double value;
    uint top = uint(uint64_t(high) >> 32);
    if (top == 0u) {
        value = double(high) * 2097152.0LF + double(low);  // below 2^53
    } else {
        int drop = findMSB(top) + 1;  // Bits that 53 do not hold: 1 to 31.
        int64_t kept = drop <= 21 ? (high << (21 - drop)) | (low >> drop) : high >> (drop - 21);
        int64_t all = drop <= 21 ? low : ((high & ((1L << (drop - 21)) - 1L)) << 21) | low;
        int64_t rest = all & ((1L << drop) - 1L);
        int64_t tie = 1L << (drop - 1);
        if (rest > tie || (rest == tie && (kept & 1L) != 0L)) kept += 1L;
        value = double(kept) * double(1L << drop);
    }
    return negative ? -value : value;
}

/// a - q b, for a q next to a / b: [Dekker 1971], without a fused product.
double remainder_of(double a, double b, double q) {
    const double splitter = 134217729.0LF;  // 2^27 + 1
    precise double qs = q * splitter;
    precise double q1 = qs - (qs - q);
    precise double q2 = q - q1;
    precise double bs = b * splitter;
    precise double b1 = bs - (bs - b);
    precise double b2 = b - b1;
    precise double product = q * b;
    precise double error = ((q1 * b1 - product) + q1 * b2 + q2 * b1) + q2 * b2;
    precise double r = (a - product) - error;
    return r;
}

/// a / b rounded to nearest, out of the device's own, which is a few units of the last place off. No tie is possible.
///
/// expects: whole numbers, |a| up to 2^53, b in [1, 2^83].
double quotient(double a, double b) {
    precise double q = a / b;
    if (a == 0.0LF) return 0.0LF;
    double r = remainder_of(a, b, q);
    for (int i = 0; i < 8 && r != 0.0LF; ++i) {
        // Bits of a float grow with its magnitude.
        int64_t away = (r > 0.0LF) == (a > 0.0LF) ? 1L : -1L;
        double next = int64BitsToDouble(doubleBitsToInt64(q) + away);
        double left = remainder_of(a, b, next);
        if (abs(left) >= abs(r)) break;
        q = next;
        r = left;
    }
    return q;
}
