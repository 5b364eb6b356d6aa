; stargrip-cam cut program
; name: every feature
; program: purpose=cut sheet=1 stars=1
; frame: origin at lower left of the sheet, Z0 on the release layer
; cutting: speed_mm_s=4 height_mm=-1
; cutting: tool=hot-tip temperature_C=350
; machine: dialect=grbl heating=operator arcs=yes line=72
; heights: contact_mm=-0.3 travel_mm=5 park_mm=30 ramp_mm=3
; path: tolerance_mm=0.001 travel_mm_s=20 dwell=s
; requires: $1=255 so that the motors hold at every stop
; requires: a send-and-wait host is late at each stroke: feedcheck
; length: cut=1 edge=registration-1 length_mm=8.383 time_s=5
; length: cut=2 edge=registration-2 length_mm=8.383 time_s=5
; length: cut=3 edge=registration-3 length_mm=8.383 time_s=5
; length: cut=4 edge=cut-hole-1 length_mm=244.246 time_s=64
; length: cut=5 edge=cut-outside-1 length_mm=444.418 time_s=114
; total: length_mm=713.812 time_s=229
G21
G17
G91.1
G90
G94
G0 Z30
; tool: tool=hot-tip temperature_C=350
; take the release layer off, keep the sheet where it is
; the hot tip in, X Y as before, its tip at Z0, press start
M0
; heat: temperature_C=350
; set the iron to 350 C, standby off, wait until hot, press start
M0
G0 X26.3026 Y17.7341
G0 Z5
; cut: cut=1 edge=registration-1 length_mm=8.383 time_s=5
; progress: percent=2 remaining_s=222
G3 X24.9844 Y18.2064 Z2 I-0.9774 J-0.6522 F240
; progress: percent=3 remaining_s=221
G3 X24.1502 Y17.0819 Z-1 I0.3408 J-1.1245
G3 X25.3252 Y15.9069 I1.175 J0
G3 X26.5002 Y17.0819 I0 J1.175
G3 X25.3252 Y18.2569 I-1.175 J0
; progress: percent=4 remaining_s=219
G3 X24.1502 Y17.0819 I0 J-1.175
G3 X24.5506 Y16.1983 I1.175 J-0.0001
G3 X25.8102 Y16.0117 Z1.6914 I0.7745 J0.8836
G3 X26.5002 Y17.0819 Z4.3827 I-0.485 J1.0702
; progress: percent=5 remaining_s=217
G3 X26.4599 Y17.387 Z5 I-1.175 J0
G0 X37.6942 Y12.4221
G0 Z5
; cut: cut=2 edge=registration-2 length_mm=8.383 time_s=5
; progress: percent=6 remaining_s=215
G3 X36.376 Y12.8944 Z2 I-0.9774 J-0.6522 F240
G3 X35.5418 Y11.7699 Z-1 I0.3408 J-1.1245
G3 X36.7168 Y10.5949 I1.175 J0
; progress: percent=7 remaining_s=213
G3 X37.8918 Y11.7699 I0 J1.175
G3 X36.7168 Y12.9449 I-1.175 J0
G3 X35.5418 Y11.7699 I0 J-1.175
G3 X35.9422 Y10.8863 I1.175 J-0.0001
G3 X37.2018 Y10.6997 Z1.6914 I0.7745 J0.8836
; progress: percent=8 remaining_s=210
G3 X37.8918 Y11.7699 Z4.3827 I-0.485 J1.0702
G3 X37.8515 Y12.075 Z5 I-1.175 J0
G0 X118.8419 Y110.2734
G0 Z5
; cut: cut=3 edge=registration-3 length_mm=8.383 time_s=5
; progress: percent=11 remaining_s=202
G3 X117.5238 Y110.7458 Z2 I-0.9774 J-0.6521 F240
G3 X116.6895 Y109.6213 Z-1 I0.3407 J-1.1245
; progress: percent=12 remaining_s=201
G3 X117.8645 Y108.4463 I1.175 J0
G3 X119.0395 Y109.6213 I0 J1.175
G3 X117.8645 Y110.7963 I-1.175 J0
G3 X116.6895 Y109.6213 I0 J-1.175
; progress: percent=13 remaining_s=199
G3 X117.09 Y108.7377 I1.175 J0
G3 X118.3496 Y108.5511 Z1.6914 I0.7745 J0.8836
G3 X119.0395 Y109.6213 Z4.3827 I-0.4851 J1.0702
G3 X118.9992 Y109.9264 Z5 I-1.175 J0
G0 X93.1987 Y77.689
G0 Z5
; cut: cut=4 edge=cut-hole-1 length_mm=244.246 time_s=64
; progress: percent=15 remaining_s=193
G1 X94.4666 Y80.4079 Z-1 F240
; progress: percent=16 remaining_s=192
G1 X96.1603 Y84.0401
G1 X97.854 Y87.6723
; progress: percent=17 remaining_s=190
G1 X99.5478 Y91.3045
G1 X95.1891 Y89.2721
; progress: percent=18 remaining_s=187
G1 X90.8305 Y87.2396
G1 X86.4718 Y85.2071
; progress: percent=19 remaining_s=185
G1 X82.1132 Y83.1746
G1 X77.7545 Y81.1422
; progress: percent=20 remaining_s=183
G2 X73.7072 Y79.9305 I-6.1597 J13.2094
G2 X69.4825 Y79.9305 I-2.1123 J14.4211
; progress: percent=21 remaining_s=180
G2 X65.4352 Y81.1422 I2.1124 J14.4211
G1 X61.0765 Y83.1746
; progress: percent=22 remaining_s=178
G1 X56.7179 Y85.2071
G1 X52.3592 Y87.2396
; progress: percent=23 remaining_s=176
G1 X48.0006 Y89.2721
G1 X43.6419 Y91.3045
; progress: percent=24 remaining_s=173
G1 X45.6744 Y86.9459
G1 X47.7069 Y82.5872
; progress: percent=25 remaining_s=171
G1 X49.7393 Y78.2286
G1 X51.7718 Y73.8699
; progress: percent=26 remaining_s=169
G1 X53.8043 Y69.5113
G2 X55.016 Y65.464 I-13.2094 J-6.1597
; progress: percent=27 remaining_s=166
G2 X55.016 Y61.2392 I-14.4211 J-2.1124
G2 X53.8043 Y57.1919 I-14.4211 J2.1124
; progress: percent=28 remaining_s=164
G1 X51.7718 Y52.8333
G1 X49.7393 Y48.4746
; progress: percent=29 remaining_s=162
G1 X47.7069 Y44.116
G1 X45.6744 Y39.7573
; progress: percent=30 remaining_s=159
G1 X43.6419 Y35.3987
G1 X48.0006 Y37.4311
; progress: percent=31 remaining_s=157
G1 X52.3592 Y39.4636
G1 X56.7179 Y41.4961
; progress: percent=32 remaining_s=155
G1 X61.0765 Y43.5286
G1 X65.4352 Y45.561
; progress: percent=33 remaining_s=152
G2 X69.4825 Y46.7727 I6.1597 J-13.2094
G2 X73.7072 Y46.7727 I2.1124 J-14.4211
; progress: percent=34 remaining_s=150
G2 X77.7545 Y45.561 I-2.1124 J-14.4211
G1 X82.1132 Y43.5286
; progress: percent=35 remaining_s=148
G1 X86.4718 Y41.4961
G1 X90.8305 Y39.4636
; progress: percent=36 remaining_s=145
G1 X95.1891 Y37.4311
G1 X99.5478 Y35.3987
; progress: percent=37 remaining_s=143
G1 X97.5153 Y39.7573
G1 X95.4828 Y44.116
; progress: percent=38 remaining_s=141
G1 X93.4504 Y48.4746
; progress: percent=39 remaining_s=139
G1 X91.4179 Y52.8333
G1 X89.3854 Y57.1919
; progress: percent=40 remaining_s=137
G2 X88.1737 Y61.2392 I13.2094 J6.1597
G2 X88.1737 Y65.464 I14.4211 J2.1124
; progress: percent=41 remaining_s=135
G2 X89.3854 Y69.5113 I14.4211 J-2.1124
G1 X91.0791 Y73.1435
G1 X92.7729 Y76.7757
; progress: percent=42 remaining_s=132
G1 X94.4666 Y80.4079
G1 X94.8892 Y81.3142
G1 X96.1571 Y84.0331 Z5
G0 X23.6319 Y78.2555
G0 Z5
; cut: cut=5 edge=cut-outside-1 length_mm=444.418 time_s=114
; progress: percent=46 remaining_s=123
G1 X24.8997 Y75.5366 Z-1 F240
G1 X26.7937 Y71.4749
; progress: percent=47 remaining_s=120
G1 X28.6877 Y67.4132
G1 X30.5817 Y63.3516
; progress: percent=48 remaining_s=118
G1 X28.6877 Y59.2899
G1 X26.7937 Y55.2283
; progress: percent=49 remaining_s=116
G1 X24.8997 Y51.1666
G1 X23.0058 Y47.105
; progress: percent=50 remaining_s=114
G1 X21.1118 Y43.0433
G1 X19.2178 Y38.9817
; progress: percent=51 remaining_s=111
G3 X17.7249 Y34.5548 I19.1005 J-8.9065
G3 X17.2439 Y29.9078 I20.5933 J-4.48
; progress: percent=52 remaining_s=109
G3 X17.7985 Y25.269 I21.0743 J0.167
G3 X19.3615 Y20.8664 I20.5197 J4.8061
; progress: percent=53 remaining_s=107
G3 X21.856 Y16.9163 I18.9567 J9.2086
G3 X25.1595 Y13.6128 I16.4622 J13.1587
; progress: percent=54 remaining_s=104
G3 X29.1096 Y11.1183 I13.1587 J16.4622
G3 X33.5123 Y9.5553 I9.2086 J18.9567
; progress: percent=55 remaining_s=102
G3 X38.1511 Y9.0007 I4.8058 J20.5197
G3 X42.7981 Y9.4816 I0.1675 J21.0743
; progress: percent=56 remaining_s=100
G3 X47.2249 Y10.9746 I-4.4802 J20.5933
G1 X51.2866 Y12.8685
; progress: percent=57 remaining_s=97
G1 X55.3482 Y14.7625
G1 X59.4099 Y16.6565
; progress: percent=58 remaining_s=95
G1 X63.4715 Y18.5505
G1 X67.5332 Y20.4445
; progress: percent=59 remaining_s=93
G1 X71.5948 Y22.3384
G1 X75.6565 Y20.4445
; progress: percent=60 remaining_s=91
G1 X79.7181 Y18.5505
G1 X83.7798 Y16.6565
; progress: percent=61 remaining_s=88
G1 X87.8415 Y14.7625
G1 X91.9031 Y12.8685
; progress: percent=62 remaining_s=86
G1 X95.9648 Y10.9746
G3 X100.3916 Y9.4816 I8.907 J19.1003
; progress: percent=63 remaining_s=84
G3 X105.0386 Y9.0007 I4.4795 J20.5934
G3 X109.6774 Y9.5553 I-0.167 J21.0743
; progress: percent=64 remaining_s=82
G3 X114.08 Y11.1183 I-4.8061 J20.5197
G3 X118.0302 Y13.6128 I-9.2083 J18.9569
; progress: percent=65 remaining_s=79
G3 X121.3336 Y16.9163 I-13.159 J16.462
G3 X123.8282 Y20.8664 I-16.462 J13.159
; progress: percent=66 remaining_s=77
G3 X125.3911 Y25.269 I-18.9569 J9.2083
G3 X125.9458 Y29.9078 I-20.5196 J4.8063
; progress: percent=67 remaining_s=75
G3 X125.4648 Y34.5548 I-21.0743 J0.167
G3 X123.9719 Y38.9817 I-20.5934 J-4.4796
; progress: percent=68 remaining_s=72
G1 X122.0779 Y43.0433
G1 X120.1839 Y47.105
; progress: percent=69 remaining_s=70
G1 X118.2899 Y51.1666
G1 X116.396 Y55.2283
; progress: percent=70 remaining_s=68
G1 X114.502 Y59.2899
G1 X112.608 Y63.3516
; progress: percent=71 remaining_s=66
G1 X114.502 Y67.4132
G1 X116.396 Y71.4749
; progress: percent=72 remaining_s=63
G1 X118.2899 Y75.5366
G1 X120.1839 Y79.5982
; progress: percent=73 remaining_s=61
G1 X122.0779 Y83.6599
G1 X123.9719 Y87.7215
; progress: percent=74 remaining_s=59
G3 X125.4648 Y92.1484 I-19.1005 J8.9065
G3 X125.9458 Y96.7954 I-20.5933 J4.48
; progress: percent=75 remaining_s=56
G3 X125.3911 Y101.4342 I-21.0743 J-0.1675
G3 X123.8282 Y105.8368 I-20.5198 J-4.8057
; progress: percent=76 remaining_s=54
G3 X121.3336 Y109.7869 I-18.9566 J-9.2089
G3 X118.0302 Y113.0904 I-16.4624 J-13.1585
; progress: percent=77 remaining_s=52
G3 X114.08 Y115.5849 I-13.1585 J-16.4624
G3 X109.6774 Y117.1479 I-9.2087 J-18.9567
; progress: percent=78 remaining_s=49
G3 X105.0386 Y117.7025 I-4.8058 J-20.5197
G3 X100.3916 Y117.2216 I-0.1675 J-21.0743
; progress: percent=79 remaining_s=47
G3 X95.9648 Y115.7286 I4.4802 J-20.5933
G1 X91.9031 Y113.8347
; progress: percent=80 remaining_s=45
G1 X87.8415 Y111.9407
G1 X83.7798 Y110.0467
; progress: percent=81 remaining_s=43
G1 X79.7181 Y108.1527
G1 X75.6565 Y106.2587
; progress: percent=82 remaining_s=40
G1 X71.5948 Y104.3648
G1 X67.5332 Y106.2587
; progress: percent=83 remaining_s=38
G1 X63.4715 Y108.1527
G1 X59.4099 Y110.0467
; progress: percent=84 remaining_s=36
G1 X55.3482 Y111.9407
G1 X51.2866 Y113.8347
; progress: percent=85 remaining_s=34
G1 X47.2249 Y115.7286
G3 X43.3152 Y117.1022 I-8.9067 J-19.1004
; progress: percent=86 remaining_s=31
G3 X39.2122 Y117.6842 I-4.997 J-20.474
G3 X35.0747 Y117.4521 I-0.8941 J-21.056
; progress: percent=87 remaining_s=29
G1 X32.2506 Y120.2762
G1 X29.4265 Y123.1003
; progress: percent=88 remaining_s=27
G1 X26.6023 Y125.9245
G3 X26.4963 Y125.9245 I-0.053 J-0.0531
G1 X23.0014 Y122.4296
; progress: percent=89 remaining_s=25
G1 X19.5065 Y118.9348
G1 X16.0117 Y115.4399
; progress: percent=90 remaining_s=23
G1 X12.5168 Y111.945
G1 X9.022 Y108.4502
; progress: percent=91 remaining_s=20
G3 X9.022 Y108.3441 I0.053 J-0.053
G1 X11.8461 Y105.52
G1 X14.6702 Y102.6959
; progress: percent=92 remaining_s=18
G1 X17.4943 Y99.8717
G3 X17.2622 Y95.7342 I20.8239 J-3.2434
G3 X17.8442 Y91.6313 I21.056 J0.8941
; progress: percent=93 remaining_s=15
G3 X19.2178 Y87.7215 I20.4741 J4.9968
G1 X21.1118 Y83.6599
; progress: percent=94 remaining_s=13
G1 X23.0058 Y79.5982
G1 X24.8997 Y75.5366
; progress: percent=95 remaining_s=11
G1 X25.3224 Y74.6302
G1 X26.5902 Y71.9113 Z5
G0 Z30
G0 X0 Y0
M2
; end of program, 326 lines
