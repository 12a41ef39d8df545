#version 450
// A group of 8 x 8: not what kernels are.
layout(local_size_x = 8, local_size_y = 8) in;
void main() {}
