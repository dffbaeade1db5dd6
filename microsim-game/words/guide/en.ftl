# The field guide: what is seen, in at most forty words, and where that is from.

## Cells and their parts

amoeboid-cell = Amoeboid cell
    .text = White blood cells and amoebae crawl without limbs: the front of the cell pushes out, and the rear is drawn in. Neutrophils, the commonest white blood cells, hunt bacteria like this.
    .source = Kolaczkowska and Kubes, 2013, Neutrophil recruitment and function in health and inflammation, Nature Reviews Immunology 13
membrane = Membrane
    .text = A double layer of lipids, five nanometres thin, holds the cell together. It bends easily, but tears when its area grows by some percent; cells keep spare membrane in folds.
    .source = Evans, Waugh and Melnik, 1976, Elastic area compressibility modulus of red cell membrane, Biophysical Journal 16
pseudopod = Pseudopod
    .text = Where filaments of actin grow, the membrane is pushed out: a pseudopod. Most new ones split off from the last one, to the left and to the right in turn.
    .source = Bosgraaf and Van Haastert, 2009, The ordered extension of pseudopodia by amoeboid cells in the absence of external cues, PLoS ONE 4
uropod = Uropod
    .text = The rear of a crawling white blood cell, the uropod, is a knob that sticks to what is behind. Myosin contracts it, which drives the rest of the cell forward.
    .source = Sánchez-Madrid and Serrador, 2009, Bringing up the rear: defining the roles of the uropod, Nature Reviews Molecular Cell Biology 10
nucleus = Nucleus
    .text = The nucleus holds the genes. It is the stiffest part of most cells, and decides whether a cell gets through a narrow gap; the lobes of a neutrophil's nucleus help.
    .source = Rowat and others, 2013, Nuclear envelope composition determines the ability of neutrophil-type cells to passage through micron-scale constrictions, Journal of Biological Chemistry 288
phagocytosis = Phagocytosis
    .text = The membrane grows around prey like a cup and closes over it. White blood cells remove bacteria like this; amoebae live on it.
    .source = Flannagan, Jaumouillé and Grinstein, 2012, The cell biology of phagocytosis, Annual Review of Pathology 7
phagosome = Phagosome
    .text = What was taken in lies in a bubble of membrane, the phagosome. It turns acid within minutes, and enzymes break the prey down.
    .source = Flannagan, Jaumouillé and Grinstein, 2012, The cell biology of phagocytosis, Annual Review of Pathology 7
division = Division
    .text = A ring of actin and myosin tightens around the middle of the cell like a purse string, until only a thread is left. It breaks, and the halves crawl apart.
    .source = Glotzer, 2005, The molecular requirements for cytokinesis, Science 307

## Other organisms

rigid-cell = Ciliate
    .text = Paramecium swims with thousands of cilia that beat in waves. A firm skin, the pellicle, gives it a shape of its own: it bends around obstacles and springs back.
    .source = Machemer, 1972, Ciliary activity and the origin of metachrony in Paramecium, Journal of Experimental Biology 57
red-cell = Red blood cell
    .text = A bag of haemoglobin without a nucleus, eight micrometres wide and thin in the middle. It carries oxygen, and bends through vessels narrower than itself.
    .source = Evans and Fung, 1972, Improved measurements of the erythrocyte geometry, Microvascular Research 4
platelet = Platelet
    .text = Platelets are fragments of giant cells of the bone marrow, two to three micrometres wide, without a nucleus. They plug wounds, and live for about a week.
    .source = Machlus and Italiano, 2013, The incredible journey: from megakaryocyte development to platelet formation, Journal of Cell Biology 201
coccus = Coccus
    .text = Staphylococcus aureus is a ball of one micrometre that cannot swim: water molecules jostle it about. It grows in clusters, like grapes.
    .source = Harris, Foster and Richards, 2002, An introduction to Staphylococcus aureus, European Cells and Materials 4
bacillus = Bacillus
    .text = Escherichia coli is a rod of one by two micrometres. It swims straight for about a second, tumbles into a new direction, and swims on. Runs towards food last longer.
    .source = Berg and Brown, 1972, Chemotaxis in Escherichia coli analysed by three-dimensional tracking, Nature 239
agar = Agar
    .text = A jelly from red algae, on which microbes have been grown since the 1880s: Fanny Hesse knew it from her kitchen. Few bacteria can digest it; cells on these slides can.
    .source = Hitchens and Leikind, 1939, The introduction of agar-agar into bacteriology, Journal of Bacteriology 37
probe = Probe
    .text = A bead of metal that an experimenter drives. With magnetic particles inside living cells Crick and Hughes felt how thick cytoplasm is.
    .source = Crick and Hughes, 1950, The physical properties of cytoplasm, Experimental Cell Research 1
custom = A body of discs
    .text = Somebody built it of discs and links. All bodies here are built so: a computer moves the discs, and then corrects them until the links fit.
    .source = Müller and others, 2007, Position based dynamics, Journal of Visual Communication and Image Representation 18

## Around them

fluid-block = Water
    .text = At the size of a cell water acts like syrup: friction beats inertia. A bacterium that stops swimming glides on for less than the width of an atom.
    .source = Purcell, 1977, Life at low Reynolds number, American Journal of Physics 45
medium = Medium
    .text = Nothing but water, salts and proteins. Its molecules knock about whatever is small: Brownian motion. Perrin measured it, and convinced the world that atoms exist.
    .source = Perrin, 1909, Mouvement brownien et réalité moléculaire, Annales de chimie et de physique 18
scent = Scent
    .text = Prey gives off molecules, which spread by diffusion. A cell compares how many it catches on its sides, and turns to where there are more: chemotaxis.
    .source = Berg and Purcell, 1977, Physics of chemoreception, Biophysical Journal 20
wall = Wall
    .text = Channels finer than a hair are moulded in silicone rubber, to watch how cells squeeze through gaps and choose their way.
    .source = Xia and Whitesides, 1998, Soft lithography, Annual Review of Materials Science 28

## Ways of looking

phase-contrast = Phase contrast
    .text = Light is delayed by a cell, which no eye can see. Frits Zernike's ring turns delay into brightness: what is thick looks dark, with a bright halo. Nobel prize of 1953.
    .source = Zernike, 1942, Phase contrast, a new method for the microscopic observation of transparent objects, Physica 9
negative-phase-contrast = Negative phase contrast
    .text = Phase contrast the other way round: what is thick shines on a grey ground, and its halo is dark.
    .source = Bennett, Osterberg, Jupnik and Richards, 1951, Phase Microscopy, Wiley
dic = Interference contrast
    .text = Two beams pass through the cell side by side, less than a micrometre apart. Where one is delayed more than the other the picture is brighter or darker, as if lit from one side.
    .source = Allen, David and Nomarski, 1969, The Zeiss-Nomarski differential interference equipment for transmitted-light microscopy, Zeitschrift für wissenschaftliche Mikroskopie 69
dark-field = Dark field
    .text = Light comes from the side and misses the lens: only what scatters it shines. Even things smaller than a wavelength are seen, though not their shape.
    .source = Gage, 1920, Modern dark-field microscopy and the history of its development, Transactions of the American Microscopical Society 39
bright-field = Bright field
    .text = Light from below, as in the first microscopes. Living cells are nearly as clear as water: edges are seen best a little out of focus.
    .source = Köhler, 1893, Ein neues Beleuchtungsverfahren für mikrophotographische Zwecke, Zeitschrift für wissenschaftliche Mikroskopie 10
stained = Stained smear
    .text = A dried drop of blood in a mix of a blue and a red dye: nuclei become violet, red cells pink, and granules tell kinds of white cells apart.
    .source = Horobin, 2011, How Romanowsky stains work and why they remain valuable, Biotechnic and Histochemistry 86
fluorescence = Fluorescence
    .text = Dyes take up light of one colour and give off another. Here one makes nuclei blue and another cytoplasm green; what has no dye stays dark.
    .source = Lichtman and Conchello, 2005, Fluorescence microscopy, Nature Methods 2
classic = Classic
    .text = How the program looked from whose thesis this one grew: cells painted with textures. No light is involved.
    .source = Simulator of Unicellular Microorganism, 2018, bachelor's thesis, Czech Technical University in Prague
drawn = Drawing
    .text = Each part in its colour, as in a textbook. Before photography microscopists drew: the first bacteria that anybody saw are in a drawing from Leeuwenhoek's letter of 1683.
    .source = Van Leeuwenhoek, 1684, An abstract of a letter, Philosophical Transactions 14
