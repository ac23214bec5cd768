# The file name extensions that OpenImageIO reads and OpenSceneGraph 3.6.5 ships no plugin for.
# OSG finds a reader by extension only, so each gets its module osgdb_<extension>;
# extension:module where OSG's alias table sends an extension to another module.
# At run time a module declines what the installed OpenImageIO was built without.
set(OSGKITS_OIIO_EXTENSIONS
    exr sxr mxr                     # OpenEXR
    tx env sm vsm                   # TIFF textures and maps
    jif jfif jfi                    # JPEG
    dib                             # BMP
    rgbe                            # Radiance
    pfm                             # float PNM
    tpic                            # Targa
    cin dpx                         # Cineon, DPX
    dcm:dicom                       # DICOM
    fits
    heic heif heics avif            # HEIF
    ico
    iff z zfile                     # Maya IFF, Pixar z depth
    jp2 j2k j2c                     # JPEG 2000
    vdb                             # OpenVDB
    psd pdd psb                     # Photoshop
    rla
    webp
    avi mov qt mp4 3gp 3g2 mj2 m4v mpg # films: one frame, chosen by oiio.subimage
    # raw camera files
    3fr arw bay bmq cap cine cr2 cr3 crw cs1 dc2 dcr dng drf dsc erf fff ia iiq k25 kc2 kdc mdc mef
    mos mrw nef nrw orf pef ptx pxn qtk raf raw rdc rw2 rwl rwz sr2 srf srw sti x3f)
